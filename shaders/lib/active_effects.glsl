// Which effects are at work in a view: one bit each, in the order of render::EffectShaders; and whether a later pass shows the light.
layout(location = 10) uniform int active_effects;

const int kKeepLight = 1 << 30;
