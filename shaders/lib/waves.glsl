// Waves of a sea: sinusoids that run around the globe, each from a point on it. Plain GLSL of plain arguments: the tests compile
// this file as C++ too.
//
// Lengths are those of round space (lib/view.glsl), where sea level is a sphere. Of a wave the eye's own nadir has the phase; from
// there a place is reached by an offset, metres.

// How much farther from a wave's source a place at sea level is than the nadir. `along`: unit, level at the nadir, which way the wave
// runs; `cotangent`: of the angle between the nadir and the source. `level_2`: square of the offset's level part. To third order in
// the offset over the radius: off by 0.4 m at 100 km, 4e-5 m at 10 km.
float wave_way(vec3 offset, float level_2, vec3 along, float cotangent, float radius) {
  float x = dot(offset, along);
  float y_2 = max(level_2 - x * x, 0.0f);
  return x + (0.5f * cotangent * y_2 + (x * x / 6.0f - 0.5f * cotangent * cotangent * y_2) * (x / radius)) / radius;
}

// Share of a wave that the mesh shows at a distance from the eye: all of it where its cells are a fraction of the wave. A function of
// the place alone, so that patches of two levels agree on what they share.
float mesh_share(float away, float wavelength) { return 1.0f - smoothstep(3.0f, 7.0f, away / wavelength); }

// Share of a wave that a pixel shows, by the phase across it, radians.
float pixel_share(float across) { return 1.0f - smoothstep(0.9f, 2.6f, across); }

// Share of the waves' heights over a floor so deep, `reach` being the sum of their amplitudes: they never bare the floor, and are
// nothing at the shore.
float shoal_share(float depth, float reach) { return smoothstep(0.0f, max(2.0f * reach, 1e-3f), depth); }
