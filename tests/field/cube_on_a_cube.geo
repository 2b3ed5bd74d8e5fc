// Hexahedra below, pyramids on them, tetrahedra above.
SetFactory("OpenCASCADE");
DefineConstant[ mesh_size = 0.25 ];
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {0, 0, 1, 1, 1, 1};
Coherence;
Mesh.MeshSizeMax = mesh_size;
Transfinite Curve{:} = 1 + 1 / mesh_size;
sides[] = Boundary{ Volume{1}; };
Transfinite Surface{sides[]};
Recombine Surface{sides[]};
Transfinite Volume{1};
Physical Volume("lower") = {1};
Physical Volume("upper") = {2};
Physical Surface("zmin") = {Surface In BoundingBox{-0.1, -0.1, -0.1, 1.1, 1.1, 0.1}};
Physical Surface("between") = {Surface In BoundingBox{-0.1, -0.1, 0.9, 1.1, 1.1, 1.1}};
Physical Surface("zmax") = {Surface In BoundingBox{-0.1, -0.1, 1.9, 1.1, 1.1, 2.1}};
Physical Surface("xmin") = {Surface In BoundingBox{-0.1, -0.1, -0.1, 0.1, 1.1, 2.1}};
Physical Surface("ymin") = {Surface In BoundingBox{-0.1, -0.1, -0.1, 1.1, 0.1, 2.1}};
