// Octant of a thick sphere, radii 1, 1.5 and 2, in tetrahedra: two shells with
// meshes of their own, which meet at the radius 1.5 but share no nodes. Volumes
// "inner" and "outer"; boundaries of each: inside, outside, xmin, ymin, zmin,
// with the name of the shell before them.
//   gmsh -3 -format msh41 thick_sphere_tet.geo
SetFactory("Built-in");
DefineConstant[ mesh_size = 0.4 ];
Mesh.MeshSizeExtendFromBoundary = 1;

// Shell between the radii a and b, from the tag n on, with edges of length h.
Macro Shell
  Point(n) = {0, 0, 0};
  For i In {0:1}
    r = (i == 0) ? a : b;
    k = n + 10 * i;
    Point(k + 1) = {r, 0, 0, h};
    Point(k + 2) = {0, r, 0, h};
    Point(k + 3) = {0, 0, r, h};
    Circle(k + 1) = {k + 1, n, k + 2};
    Circle(k + 2) = {k + 2, n, k + 3};
    Circle(k + 3) = {k + 3, n, k + 1};
    Curve Loop(k + 1) = {k + 1, k + 2, k + 3};
    Surface(k + 1) = {k + 1} In Sphere {n};
  EndFor
  For i In {1:3}
    Line(n + 20 + i) = {n + i, n + 10 + i};
  EndFor
  // plane between the axes i and i + 1
  For i In {1:3}
    j = (i == 3) ? 1 : i + 1;
    Curve Loop(n + 20 + i) = {n + 20 + i, n + 10 + i, -(n + 20 + j), -(n + i)};
    Plane Surface(n + 20 + i) = {n + 20 + i};
  EndFor
  Surface Loop(n + 1) = {n + 1, n + 11, n + 21, n + 22, n + 23};
  Volume(n + 1) = {n + 1};
Return

n = 100; a = 1; b = 1.5; h = mesh_size;
Call Shell;
n = 200; a = 1.5; b = 2; h = 1.3 * mesh_size;
Call Shell;

Physical Volume("inner", 1) = {101};
Physical Volume("outer", 2) = {201};
Physical Surface("inner inside", 11) = {101};
Physical Surface("inner outside", 12) = {111};
Physical Surface("inner zmin", 13) = {121};
Physical Surface("inner xmin", 14) = {122};
Physical Surface("inner ymin", 15) = {123};
Physical Surface("outer inside", 21) = {201};
Physical Surface("outer outside", 22) = {211};
Physical Surface("outer zmin", 23) = {221};
Physical Surface("outer xmin", 24) = {222};
Physical Surface("outer ymin", 25) = {223};
