// attributes.glsl — A triangle's attribute, carried to [0,1] between the mesh's lowest and highest. Needs buffers class_of, class_values.
#ifndef SCENE_ANALYZER_LIB_ATTRIBUTES
#define SCENE_ANALYZER_LIB_ATTRIBUTES

// 1 / (highest - lowest), or 0 for a mesh that is uniform to float precision: all its attributes are then equal.
double inverse_span(ClassRange range) {
  double span = range.highest - range.lowest;
  return span <= 1e-5LF * range.highest ? 0.0LF : 1.0LF / span;
}

double attribute_of(uint triangle, ClassRange range, double scale) {
  return (class_values[class_of[triangle]] - range.lowest) * scale;
}

// The nearest of kAttributeSteps + 1 equally spaced values.
double in_steps(double value) {
  return floor(value * kAttributeSteps + 0.5LF) / kAttributeSteps;
}

#endif
