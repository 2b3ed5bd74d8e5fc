// Half of a plate (y > 0), 60 by 10 by 5 [mm], with a hole of radius 5.5 around the z axis. Faces: end, hole, symmetry, lap (z = 0), outer (z = 5).
SetFactory("OpenCASCADE");
DefineConstant[ mesh_size = 4 ];
Box(1) = {-15, 0, 0, 60, 12, 5};
Cylinder(2) = {0, 0, -1, 0, 0, 7, 5.5};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Volume("plate") = {3};
e = 1e-3;
Physical Surface("end") = Surface In BoundingBox{45 - e, -e, -e, 45 + e, 12 + e, 5 + e};
Physical Surface("symmetry") = Surface In BoundingBox{-15 - e, -e, -e, 45 + e, e, 5 + e};
Physical Surface("lap") = Surface In BoundingBox{-15 - e, -e, -e, 45 + e, 12 + e, e};
Physical Surface("outer") = Surface In BoundingBox{-15 - e, -e, 5 - e, 45 + e, 12 + e, 5 + e};
Mesh.MeshSizeMax = mesh_size;
