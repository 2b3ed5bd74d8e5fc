// Lower half of a flanged pipe joint, a quarter of it, in hexahedra: pipe of
// radii 50 and 60 and a flange up to the radius 115 with two holes of radius 9
// on the radius 97 (at 22.5 and 67.5 degrees); millimetres. The gasket lies on z = 0.
// Boundaries: bore, pipe (outside), rim, holes, face (z = 0), back (z = -20, where the nuts sit),
// end (z = -80), xmin, ymin.
SetFactory("OpenCASCADE");
DefineConstant[ mesh_size = 11 ];

Disk(1) = {0, 0, 0, 50};
Disk(2) = {0, 0, 0, 60};
Disk(3) = {0, 0, 0, 115};
Disk(4) = {89.61631, 37.1203, 0, 9};
Disk(5) = {37.1203, 89.61631, 0, 9};
Rectangle(6) = {0, 0, 0, 120, 120};
BooleanDifference(11) = { Surface{2}; }{ Surface{1}; Delete; };
BooleanDifference(12) = { Surface{3}; Delete; }{ Surface{2, 4, 5}; Delete; };
BooleanIntersection(21) = { Surface{11}; Delete; }{ Surface{6}; };
BooleanIntersection(22) = { Surface{12}; Delete; }{ Surface{6}; Delete; };
BooleanFragments{ Surface{21}; Delete; }{ Surface{22}; Delete; }

MeshSize{:} = mesh_size;
Mesh.MeshSizeFromCurvature = 0;
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 1;
Recombine Surface{:};

wall() = Surface In BoundingBox{-1, -1, -1, 61, 61, 1};
plate() = Surface{:};
// the wall has a structured mesh, the plate an unstructured one
around() = Curve In BoundingBox{-1, -1, -1, 61, 61, 1};
ends() = Curve In BoundingBox{-0.1, -1, -1, 0.1, 61, 1};
ends() += Curve In BoundingBox{-1, -0.1, -1, 61, 0.1, 1};
around() -= ends();
Transfinite Curve{around()} = 9;
Transfinite Curve{ends()} = 2;
Transfinite Surface{wall()};
plate() -= wall();
a() = Extrude{0, 0, -20}{ Surface{wall(0), plate(0)}; Layers{2}; Recombine; };
low() = Surface In BoundingBox{-1, -1, -21, 61, 61, -19};
b() = Extrude{0, 0, -60}{ Surface{low(0)}; Layers{5}; Recombine; };

Physical Volume("lower flange", 1) = Volume{:};
Physical Surface("face", 1) = {wall(0), plate(0)};
Physical Surface("end", 2) = Surface In BoundingBox{-1, -1, -81, 61, 61, -79};
Physical Surface("xmin", 3) = Surface In BoundingBox{-0.1, -1, -81, 0.1, 116, 1};
Physical Surface("ymin", 4) = Surface In BoundingBox{-1, -0.1, -81, 116, 0.1, 1};
back() = Surface In BoundingBox{-1, -1, -20.1, 116, 116, -19.9};
back() -= low();
Physical Surface("back", 5) = back();
bore() = Surface In BoundingBox{-1, -1, -81, 50.1, 50.1, 1};
bore() -= Surface In BoundingBox{-0.1, -1, -81, 0.1, 116, 1};
bore() -= Surface In BoundingBox{-1, -0.1, -81, 116, 0.1, 1};
Physical Surface("bore", 6) = bore();
pipe() = Surface In BoundingBox{-1, -1, -81, 60.1, 60.1, -19};
pipe() -= Surface In BoundingBox{-1, -1, -81, 50.1, 50.1, 1};
pipe() -= Surface In BoundingBox{-0.1, -1, -81, 0.1, 116, 1};
pipe() -= Surface In BoundingBox{-1, -0.1, -81, 116, 0.1, 1};
pipe() -= Surface In BoundingBox{-1, -1, -81, 61, 61, -79};
pipe() -= low();
Physical Surface("pipe", 7) = pipe();
rim() = Surface In BoundingBox{-1, -1, -21, 116, 116, 1};
rim() -= Surface In BoundingBox{-1, -1, -21, 114, 114, 1};
rim() -= Surface In BoundingBox{-0.1, -1, -81, 0.1, 116, 1};
rim() -= Surface In BoundingBox{-1, -0.1, -81, 116, 0.1, 1};
rim() -= back();
rim() -= {plate(0)};
Physical Surface("rim", 8) = rim();
hole() = Surface In BoundingBox{20, 20, -21, 108, 108, 1};
Physical Surface("holes", 9) = hole();
