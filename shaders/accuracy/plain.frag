// One colour, where vertices are what is measured.
out vec4 color;

void main() { color = vec4(1.0); }
