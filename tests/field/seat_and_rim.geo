// A block with two named parts of its top: the seat of a smaller block, and the rim around it.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 3, 3, 1};
Rectangle(100) = {1, 1, 1, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Surface{100}; Delete; }
MeshSize{:} = 0.9;
e = 1e-3;
Physical Volume("block") = Volume{:};
seat() = Surface In BoundingBox{1 - e, 1 - e, 1 - e, 2 + e, 2 + e, 1 + e};
rim() = Surface In BoundingBox{-e, -e, 1 - e, 3 + e, 3 + e, 1 + e};
rim() -= seat();
Physical Surface("seat") = seat();
Physical Surface("rim") = rim();
Physical Surface("bottom") = Surface In BoundingBox{-e, -e, -e, 3 + e, 3 + e, e};
Physical Surface("left") = Surface In BoundingBox{-e, -e, -e, e, 3 + e, 1 + e};
Physical Surface("front") = Surface In BoundingBox{-e, -e, -e, 3 + e, e, 1 + e};
