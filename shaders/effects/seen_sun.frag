// How much of the sun's disc is seen in a picture of light: the mean over the disc, in units of the sun's own light.
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D depth;
layout(location = 0) uniform vec4 disc;  // middle in texels, radius in texels, the sun's light

out vec4 seen;

const int kAcross = 8;
const float kNotSun = 0.01;  // of its light: the sky beside it and clouds that it shines through are no brighter

void main() {
  vec3 sum = vec3(0.0);
  float count = 0.0;
  ivec2 size = textureSize(picture, 0);
  for (int k = 0; k < kAcross * kAcross; ++k) {
    vec2 at = (vec2(k % kAcross, k / kAcross) + 0.5) * (2.0 / float(kAcross)) - 1.0;
    if (dot(at, at) > 1.0) continue;
    ivec2 texel = ivec2(disc.xy + at * disc.z);
    count += 1.0;
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size))) continue;
    if (texelFetch(depth, texel, 0).r > 0.0) continue;
    sum += clamp(texelFetch(picture, texel, 0).rgb / disc.w - kNotSun, 0.0, 1.0);
  }
  seen = vec4(sum / count, 1.0);
}
