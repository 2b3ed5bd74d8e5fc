// A block of edges 1 below z = 0, in tetrahedra that shrink towards the origin,
// from mesh_size to a twelfth of it. Boundaries: top, bottom, xmin, ymin.
//   gmsh -3 hertz_block.geo
SetFactory("OpenCASCADE");
DefineConstant[ mesh_size = 0.3 ];
Box(1) = {0, 0, -1, 1, 1, 1};
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Field[1] = MathEval;
Field[1].F = Sprintf("Min(%g, Max(%g, %g * Sqrt(x * x + y * y + z * z)))", mesh_size, mesh_size / 12, mesh_size);
Background Field = 1;
e = 1e-4;
Physical Volume("block", 1) = {Volume{:}};
Physical Surface("top", 1) = {Surface In BoundingBox{-e, -e, -e, 1 + e, 1 + e, e}};
Physical Surface("bottom", 2) = {Surface In BoundingBox{-e, -e, -1 - e, 1 + e, 1 + e, -1 + e}};
Physical Surface("xmin", 3) = {Surface In BoundingBox{-e, -e, -1 - e, e, 1 + e, e}};
Physical Surface("ymin", 4) = {Surface In BoundingBox{-e, -e, -1 - e, 1 + e, e, e}};
