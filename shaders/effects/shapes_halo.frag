// Darkens a picture by its own alpha: the blending does it.
out vec4 color;

void main() { color = vec4(0.0); }
