// planarity.glsl — When two neighbours are coplanar within alpha and the precision of float32 coordinates.
#ifndef SCENE_ANALYZER_LIB_PLANARITY
#define SCENE_ANALYZER_LIB_PLANARITY

const double kPi = 3.14159265358979323846LF;

// clamp(4 d (1/h_i + 1/h_j), 0.01 degree, 1 degree), d = 2^-24 x largest |coordinate|; radians.
double tolerance_of(double largest_coordinate, double height_i, double height_j) {
  double d = largest_coordinate * 5.9604644775390625e-8LF;
  return clamp(4.0LF * d * (1.0LF / height_i + 1.0LF / height_j), kPi / 18000.0LF, kPi / 180.0LF);
}

// Sine and cosine of alpha + tolerance; the series are exact to double precision for angles up to 1 degree.
dvec2 sine_and_cosine(double sin_alpha, double cos_alpha, double tolerance) {
  double x2 = tolerance * tolerance;
  double sine = tolerance * (1.0LF - x2 / 6.0LF * (1.0LF - x2 / 20.0LF * (1.0LF - x2 / 42.0LF)));
  double cosine = 1.0LF - x2 / 2.0LF * (1.0LF - x2 / 12.0LF * (1.0LF - x2 / 30.0LF));
  return dvec2(sin_alpha * cosine + cos_alpha * sine, cos_alpha * cosine - sin_alpha * sine);
}

// Whether atan2(opposite, adjacent) <= bound for bound in [0, pi), opposite >= 0: the angle's difference to the bound, turned
// back by it, has no positive sine. Equal directions that point away from each other are the one case to tell apart.
bool within_angle(double opposite, double adjacent, dvec2 bound) {
  double beyond = opposite * bound.y - adjacent * bound.x;
  double along = adjacent * bound.y + opposite * bound.x;
  return beyond < 0.0LF || (beyond == 0.0LF && along >= 0.0LF);
}

#endif
