// A bolt with its nut for the flanged pipe joint, in tetrahedra: shank of radius
// 8 about the z axis, hexagons of 24 across flats and 12 thick above z = 23 and
// below z = -20. What sits on the flanges, beyond the radius 10, is "head"
// and "nut"; also: shank. Millimetres.
SetFactory("OpenCASCADE");
DefineConstant[ mesh_size = 7 ];
r = 12 / Cos(Pi/6);
For i In {0:5}
  Point(1 + i) = {r * Cos(i * Pi/3), r * Sin(i * Pi/3), 23};
EndFor
For i In {0:5}
  Line(1 + i) = {1 + i, 1 + (i + 1) % 6};
EndFor
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};
Extrude{0, 0, 12}{ Surface{1}; }
t() = Translate{0, 0, -55}{ Duplicata{ Volume{1}; } };
Cylinder(3) = {0, 0, -20, 0, 0, 43, 8};
BooleanUnion(4) = { Volume{3}; Delete; }{ Volume{1, 2}; Delete; };
// the seats begin beyond the rim of the holes
Circle(101) = {0, 0, 23, 10};
Circle(102) = {0, 0, -20, 10};
BooleanFragments{ Volume{4}; Delete; }{ Curve{101, 102}; Delete; }
MeshSize{:} = mesh_size;

Physical Volume("bolt", 1) = Volume{:};
head() = Surface In BoundingBox{-15, -15, 22.9, 15, 15, 23.1};
head() -= Surface In BoundingBox{-10.1, -10.1, 22.9, 10.1, 10.1, 23.1};
nut() = Surface In BoundingBox{-15, -15, -20.1, 15, 15, -19.9};
nut() -= Surface In BoundingBox{-10.1, -10.1, -20.1, 10.1, 10.1, -19.9};
Physical Surface("head", 1) = head();
Physical Surface("nut", 2) = nut();
Physical Surface("shank", 3) = Surface In BoundingBox{-8.1, -8.1, -20.1, 8.1, 8.1, 23.1};
