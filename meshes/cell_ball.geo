// The ball of cell_matrix.geo.
SetFactory("OpenCASCADE");
Sphere(1) = {0.5, 0.5, 0.5, 0.3};
Physical Surface("skin") = {1};
Physical Volume("ball") = {1};
MeshSize{:} = 0.2;
