// Octant of a thick sphere, radii 1, 1.5 and 2, in hexahedra: each shell is
// three blocks around the axes, with subdivisions of its own; nothing is shared
// at the radius 1.5. Names as in thick_sphere_tet.geo.
//   gmsh -3 -format msh41 thick_sphere_hex.geo
SetFactory("Built-in");
DefineConstant[ mesh_size = 0.4 ];

// Shell between the radii a and b, from the tag n on: m cells along the edge of
// a block, l from a to b.
Macro Shell
  Point(n) = {0, 0, 0};
  For i In {0:1}
    r = (i == 0) ? a : b;
    k = n + 10 * i;
    s = r / Sqrt(2);
    t = r / Sqrt(3);
    Point(k + 1) = {r, 0, 0};
    Point(k + 2) = {0, r, 0};
    Point(k + 3) = {0, 0, r};
    Point(k + 4) = {s, s, 0}; // between the axes 1 and 2
    Point(k + 5) = {0, s, s};
    Point(k + 6) = {s, 0, s};
    Point(k + 7) = {t, t, t};
    For c In {1:3}
      d = (c == 3) ? 1 : c + 1;
      Circle(k + c) = {k + c, n, k + 3 + c};
      Circle(k + 3 + c) = {k + 3 + c, n, k + d};
      Circle(k + 6 + c) = {k + 3 + c, n, k + 7};
    EndFor
    For c In {1:3}
      d = (c == 1) ? 3 : c - 1;
      Curve Loop(k + c) = {k + c, k + 6 + c, -(k + 6 + d), k + 3 + d};
      Surface(k + c) = {k + c} In Sphere {n};
    EndFor
    Transfinite Curve{k + 1:k + 9} = m + 1;
  EndFor
  For c In {1:7}
    Line(n + 20 + c) = {n + c, n + 10 + c};
  EndFor
  Transfinite Curve{n + 21:n + 27} = l + 1;
  For c In {1:3}
    d = (c == 3) ? 1 : c + 1;
    Curve Loop(n + 20 + c) = {n + 20 + c, n + 10 + c, -(n + 23 + c), -(n + c)};
    Plane Surface(n + 20 + c) = {n + 20 + c};
    Curve Loop(n + 23 + c) = {n + 23 + c, n + 13 + c, -(n + 20 + d), -(n + 3 + c)};
    Plane Surface(n + 23 + c) = {n + 23 + c};
    Curve Loop(n + 26 + c) = {n + 23 + c, n + 16 + c, -(n + 27), -(n + 6 + c)};
    Plane Surface(n + 26 + c) = {n + 26 + c};
  EndFor
  For c In {1:3}
    d = (c == 1) ? 3 : c - 1;
    Surface Loop(n + c) = {n + c, n + 10 + c, n + 20 + c, n + 26 + c, n + 26 + d, n + 23 + d};
    Volume(n + c) = {n + c};
  EndFor
  Transfinite Surface{n + 1:n + 3, n + 11:n + 13, n + 21:n + 29};
  Recombine Surface{n + 1:n + 3, n + 11:n + 13, n + 21:n + 29};
  Transfinite Volume{n + 1:n + 3};
Return

n = 100; a = 1; b = 1.5; m = Ceil(0.8 / mesh_size); l = Ceil(0.5 / mesh_size);
Call Shell;
n = 200; a = 1.5; b = 2; m = Ceil(1.2 / mesh_size); l = Ceil(0.5 / mesh_size);
Call Shell;

Physical Volume("inner", 1) = {101:103};
Physical Volume("outer", 2) = {201:203};
Physical Surface("inner inside", 11) = {101:103};
Physical Surface("inner outside", 12) = {111:113};
Physical Surface("inner zmin", 13) = {121, 124};
Physical Surface("inner xmin", 14) = {122, 125};
Physical Surface("inner ymin", 15) = {123, 126};
Physical Surface("outer inside", 21) = {201:203};
Physical Surface("outer outside", 22) = {211:213};
Physical Surface("outer zmin", 23) = {221, 224};
Physical Surface("outer xmin", 24) = {222, 225};
Physical Surface("outer ymin", 25) = {223, 226};
