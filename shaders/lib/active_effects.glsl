// Which effects are at work in a view: one bit each, in the order of render::EffectShaders; and whether a later pass shows the light.
// A program for one set of them knows it when it is compiled (render::EffectProgram).
#ifdef ACTIVE_EFFECTS
const int active_effects = ACTIVE_EFFECTS;
#else
layout(location = 10) uniform int active_effects;
#endif

const int kKeepLight = 1 << 30;
