// complex.glsl — Complex numbers as dvec2(re, im).
#ifndef SCENE_ANALYZER_SPECTRUM_COMPLEX
#define SCENE_ANALYZER_SPECTRUM_COMPLEX

dvec2 times(dvec2 a, dvec2 b) { return dvec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x); }
dvec2 conjugate(dvec2 a) { return dvec2(a.x, -a.y); }
dvec2 times_minus_i(dvec2 a) { return dvec2(a.y, -a.x); }
double magnitude_of(dvec2 a) { return sqrt(a.x * a.x + a.y * a.y); }

#endif
