// Upper half of half a bolt (y > 0) [mm]: a shank of radius 5 up to z = 5, above it a head of radius 9. Faces: cut (z = 0), symmetry, bearing (below the head).
SetFactory("OpenCASCADE");
DefineConstant[ mesh_size = 3 ];
Cylinder(1) = {0, 0, 0, 0, 0, 5, 5, Pi};
Cylinder(2) = {0, 0, 5, 0, 0, 4, 9, Pi};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Volume("bolt") = {3};
e = 1e-3;
Physical Surface("cut") = Surface In BoundingBox{-5 - e, -e, -e, 5 + e, 5 + e, e};
Physical Surface("symmetry") = Surface In BoundingBox{-9 - e, -e, -e, 9 + e, e, 9 + e};
Physical Surface("bearing") = Surface In BoundingBox{-9 - e, -e, 5 - e, 9 + e, 9 + e, 5 + e};
Mesh.MeshSizeMax = mesh_size;
