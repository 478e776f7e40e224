// row_order.glsl — In which order numbers lie in a row; see RowShape. Needs nothing.
#ifndef SCENE_ANALYZER_SPECTRUM_ROW_ORDER
#define SCENE_ANALYZER_SPECTRUM_ROW_ORDER

// The number that lies at a place.
uint number_at(uint place, RowShape shape) {
  uint number = place >> shape.inner_bits;
  uint scale = shape.radix;
  uint bits = shape.inner_bits;
  for (uint radices = shape.inner_radices; radices != 0; radices >>= 4) {
    uint radix_bits = radices & 15u;
    bits -= radix_bits;
    number += scale * ((place >> bits) & ((1u << radix_bits) - 1u));
    scale <<= radix_bits;
  }
  return number + scale * (place & ((1u << bits) - 1u));
}

// The place where a number lies. Numbers are below 2^25, so the quotient is exact.
uint place_of_number(uint number, RowShape shape) {
  uint rest = uint((double(number) + 0.5LF) / double(shape.radix));
  uint bits = shape.inner_bits;
  uint place = (number - rest * shape.radix) << bits;
  for (uint radices = shape.inner_radices; radices != 0; radices >>= 4) {
    uint radix_bits = radices & 15u;
    bits -= radix_bits;
    place += (rest & ((1u << radix_bits) - 1u)) << bits;
    rest >>= radix_bits;
  }
  return place + rest;
}

#endif
