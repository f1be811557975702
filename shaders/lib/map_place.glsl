// Latitude and longitude of places near an eye as differences from the eye's own, whose error is a ten-millionth of the distance:
// plain GLSL of plain arguments, which the tests compile as C++ too. Mirrors effects::MapEye.
struct MapEye {
  vec4 axes;     // unit vector from the planet's axis to the eye (x, y); sine and cosine of the eye's latitude
  vec4 lengths;  // metres: from the axis to the eye, along the eye's vertical to the axis, equatorial radius; w: eccentricity squared
};

// A place at `relative` metres from the eye.
struct MapPlace {
  vec2 offset;  // longitude and latitude less the eye's, radians; the longitude within pi
  vec3 east;    // unit
  vec3 north;
  float axis;      // metres from the planet's axis: length of a radian of longitude
  float meridian;  // length of a radian of latitude
};

MapPlace map_place(MapEye eye, vec3 relative) {
  float e2 = eye.lengths.w;
  float away = relative.x * eye.axes.x + relative.y * eye.axes.y;
  float aside = relative.y * eye.axes.x - relative.x * eye.axes.y;
  float axis = length(vec2(eye.lengths.x + away, aside));
  // In the plane of the place's meridian, along the eye's north and up.
  float out_by = (2.0f * eye.lengths.x * away + away * away + aside * aside) / (axis + eye.lengths.x);
  float north = eye.axes.w * relative.z - eye.axes.z * out_by;
  float up = eye.lengths.y + eye.axes.z * relative.z + eye.axes.w * out_by;
  // The vertical through the place meets the axis where tan d = (north + e2 cos(lat)/cos(d) (N sin(lat) - N0 sin(lat0))) / up; each
  // round takes the error of d times e2. Cosine and sine of d are held, for an angle would be turned into them again and again.
  vec2 turn = vec2(up, north);
  turn = turn / length(turn);
  float root0 = sqrt(1.0f - e2 * eye.axes.z * eye.axes.z);
  for (int k = 0; k < 3; ++k) {
    float sine = eye.axes.z * turn.x + eye.axes.w * turn.y;
    float cosine = eye.axes.w * turn.x - eye.axes.z * turn.y;
    float half_cosine = sqrt(max(0.5f + 0.5f * turn.x, 1e-12f));
    float half_sine = 0.5f * turn.y / half_cosine;
    float rise = 2.0f * half_sine * (eye.axes.w * half_cosine - eye.axes.z * half_sine);  // of the sine, from the eye's
    float root = sqrt(1.0f - e2 * sine * sine);
    float term = eye.lengths.z * rise * (1.0f / root + e2 * eye.axes.z * (sine + eye.axes.z) / (root * root0 * (root + root0)));
    vec2 next = vec2(up, north + e2 * cosine / turn.x * term);
    turn = abs(turn.x) > 0.02f ? next / length(next) : turn;
  }
  MapPlace place;
  place.offset = vec2(atan(aside, eye.lengths.x + away), atan(turn.y, turn.x));
  float sine = eye.axes.z * turn.x + eye.axes.w * turn.y;
  float cosine = eye.axes.w * turn.x - eye.axes.z * turn.y;
  vec2 out_dir = vec2(eye.axes.x * (eye.lengths.x + away) - eye.axes.y * aside,
                      eye.axes.y * (eye.lengths.x + away) + eye.axes.x * aside) / max(axis, 1e-3f);
  place.east = vec3(-out_dir.y, out_dir.x, 0.0f);
  place.north = vec3(-sine * out_dir.x, -sine * out_dir.y, cosine);
  place.axis = axis;
  float w = 1.0f - e2 * sine * sine;
  // Along the meridian the ellipsoid is curved otherwise than across it; both grow by the height.
  place.meridian = axis / max(cosine, 1e-4f) - eye.lengths.z * e2 * cosine * cosine / (w * sqrt(w));
  return place;
}
