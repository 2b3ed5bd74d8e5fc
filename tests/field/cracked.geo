// The upper half of a block whose lower face is a ligament (x < 0.45) and the face of a crack.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 1, 0.45, 1, 1};
Box(2) = {0.45, 0, 1, 0.55, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
e = 1e-4;
Physical Surface("ligament") = Surface In BoundingBox{-e, -e, 1 - e, 0.45 + e, 1 + e, 1 + e};
Physical Surface("crack") = Surface In BoundingBox{0.45 - e, -e, 1 - e, 1 + e, 1 + e, 1 + e};
Physical Surface("top") = Surface In BoundingBox{-e, -e, 2 - e, 1 + e, 1 + e, 2 + e};
Physical Volume("half") = {1, 2};
Mesh.MeshSizeMax = 0.5;
