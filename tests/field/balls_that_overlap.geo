// A ball between the spheres of radii 1 and 1.6 and its socket between those of radii 1.5 and 2, whole, in hexahedra, which overlap: each
// is six blocks of one layer, with subdivisions of its own; The part to take: ball or socket.
SetFactory("Built-in");
DefineConstant[ mesh_size = 1 ];

// Shell between the radii a and b, from the tag n on: m cells along the edge of a block.
Macro Shell
  Point(n) = {0, 0, 0};
  For i In {0:1}
    k = n + 100 * i;
    s = ((i == 0) ? a : b) / Sqrt(3);
    For c In {0:3}
      x = (c == 0 || c == 3) ? s : -s;
      y = (c < 2) ? s : -s;
      Point(k + 1 + c) = {x, y, -s};
      Point(k + 5 + c) = {x, y, s};
    EndFor
    For c In {1:4}
      d = (c == 4) ? 1 : c + 1;
      Circle(k + c) = {k + c, n, k + d};
      Circle(k + 4 + c) = {k + 4 + c, n, k + 4 + d};
      Circle(k + 8 + c) = {k + c, n, k + 4 + c};
    EndFor
    For c In {1:4}
      d = (c == 4) ? 1 : c + 1;
      Curve Loop(k + c) = {k + c, k + 8 + d, -(k + 4 + c), -(k + 8 + c)};
      Surface(k + c) = {k + c} In Sphere {n};
    EndFor
    Curve Loop(k + 5) = {k + 1:k + 4};
    Surface(k + 5) = {k + 5} In Sphere {n};
    Curve Loop(k + 6) = {k + 5:k + 8};
    Surface(k + 6) = {k + 6} In Sphere {n};
    Transfinite Curve{k + 1:k + 12} = m + 1;
    Transfinite Surface{k + 1:k + 6};
    Recombine Surface{k + 1:k + 6};
  EndFor
  For c In {1:8}
    Line(n + 200 + c) = {n + c, n + 100 + c};
  EndFor
  Transfinite Curve{n + 201:n + 208} = 2;
  For c In {1:4}
    d = (c == 4) ? 1 : c + 1;
    Curve Loop(n + 200 + c) = {n + c, n + 200 + d, -(n + 100 + c), -(n + 200 + c)};
    Curve Loop(n + 204 + c) = {n + 4 + c, n + 204 + d, -(n + 104 + c), -(n + 204 + c)};
    Curve Loop(n + 208 + c) = {n + 8 + c, n + 204 + c, -(n + 108 + c), -(n + 200 + c)};
    For i In {0:2}
      Plane Surface(n + 200 + 4 * i + c) = {n + 200 + 4 * i + c};
    EndFor
  EndFor
  Transfinite Surface{n + 201:n + 212};
  Recombine Surface{n + 201:n + 212};
  For c In {1:4}
    d = (c == 4) ? 1 : c + 1;
    Surface Loop(n + c) = {n + c, n + 100 + c, n + 200 + c, n + 208 + d, n + 204 + c, n + 208 + c};
    Volume(n + c) = {n + c};
  EndFor
  Surface Loop(n + 5) = {n + 5, n + 105, n + 201:n + 204};
  Volume(n + 5) = {n + 5};
  Surface Loop(n + 6) = {n + 6, n + 106, n + 205:n + 208};
  Volume(n + 6) = {n + 6};
  Transfinite Volume{n + 1:n + 6};
Return

n = 1000; a = 1; b = 1.6; m = Ceil(3 / mesh_size);
Call Shell;
n = 2000; a = 1.5; b = 2; m = Ceil(2 / mesh_size);
Call Shell;
Physical Volume("ball", 1) = {1001:1006};
Physical Surface("ball inside", 11) = {1001:1006};
Physical Surface("ball outside", 12) = {1101:1106};
Physical Volume("socket", 2) = {2001:2006};
Physical Surface("socket inside", 21) = {2001:2006};
Physical Surface("socket outside", 22) = {2101:2106};
