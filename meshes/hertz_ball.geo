// A quarter of a half ball of radius 1 whose lowest point is the origin, in
// tetrahedra that shrink towards it, from mesh_size to a twelfth of it.
// Boundaries: outside, top, xmin, ymin.
//   gmsh -3 hertz_ball.geo
SetFactory("OpenCASCADE");
DefineConstant[ mesh_size = 0.3 ];
Sphere(1) = {0, 0, 1, 1, -Pi/2, 0, Pi/2};
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Field[1] = MathEval;
Field[1].F = Sprintf("Min(%g, Max(%g, %g * Sqrt(x * x + y * y + z * z)))", mesh_size, mesh_size / 12, mesh_size);
Background Field = 1;
e = 1e-4;
Physical Volume("ball", 1) = {Volume{:}};
top() = Surface In BoundingBox{-e, -e, 1 - e, 1 + e, 1 + e, 1 + e};
xmin() = Surface In BoundingBox{-e, -e, -e, e, 1 + e, 1 + e};
ymin() = Surface In BoundingBox{-e, -e, -e, 1 + e, e, 1 + e};
outside() = Surface{:};
outside() -= {top(), xmin(), ymin()};
Physical Surface("outside", 1) = {outside()};
Physical Surface("top", 2) = {top()};
Physical Surface("xmin", 3) = {xmin()};
Physical Surface("ymin", 4) = {ymin()};
