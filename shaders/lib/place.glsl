// Where a pixel of a surface lies, for effects that change its light.
#include "lib/view.glsl"

const float kSkyDistance = 1e12;  // metres, of the sky as a place

struct Place {
  vec3 relative;  // metres from the eye, world axes
  vec3 up;        // the ellipsoid's normal
  vec3 round;     // unit vector from the planet's centre in round space, where the ellipsoid is a sphere
  float height;   // metres above the ellipsoid
  vec3 left;      // share of the light that starts here and reaches the eye
};

// Rounded to half a metre on a planet like the Earth, as `view.eye_km` is.
Place place_at(vec3 relative, float height, vec3 left) {
  vec3 round = normalize(view.eye_km.xyz + relative * 1e-3 * view.rounding.xxy);
  return Place(relative, normalize(round * view.rounding.xxy), round, height, left);
}
