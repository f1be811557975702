// How far a vertex of endless ground has gone over to the next coarser level, plain GLSL of plain arguments; flat/fractal/morph.cpp
// compiles this file as C++ too.
float share_of_band(float away, float begin, float end) { return min(max((away - begin) / (end - begin), 0.0f), 1.0f); }
