// triangles.glsl — Double-precision shape of one triangle.
#ifndef SCENE_ANALYZER_LIB_TRIANGLES
#define SCENE_ANALYZER_LIB_TRIANGLES

struct TriangleShape {
  dvec3 normal;         // not normalised: twice the area long
  double twice_area;
  double longest_edge;
};

TriangleShape shape_of(dvec3 a, dvec3 b, dvec3 c) {
  precise dvec3 ab = b - a;
  precise dvec3 ac = c - a;
  precise dvec3 bc = c - b;
  TriangleShape shape;
  precise dvec3 normal = dvec3(ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z, ab.x * ac.y - ab.y * ac.x);
  precise double squared_area = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z;
  precise double ab2 = ab.x * ab.x + ab.y * ab.y + ab.z * ab.z;
  precise double ac2 = ac.x * ac.x + ac.y * ac.y + ac.z * ac.z;
  precise double bc2 = bc.x * bc.x + bc.y * bc.y + bc.z * bc.z;
  shape.normal = normal;
  shape.twice_area = sqrt(squared_area);
  shape.longest_edge = sqrt(max(ab2, max(ac2, bc2)));
  return shape;
}

// Height over the longest edge.
double least_height(TriangleShape shape) { return shape.twice_area / shape.longest_edge; }

#endif
