// Half of the length of a round bar, a quarter of its section: radius 6.413, half length 26.667. Its middle, z = 0, is thinner by 1.8 %.
// Hexahedra of second order: three blocks of the section, layers finer towards the middle; foot is the part below z = h, head the one above.
R = 6.413; L = 26.667; h = 8; c = 0.55;
DefineConstant[ mesh_size = 2 ];
n = Ceil(0.6 * R / mesh_size);
z() = {0, h, L};
For k In {0:2}
  r = R * (0.982 + 0.018 * z(k) / L);
  q = 100 * k;
  Point(q + 1) = {0, 0, z(k)};
  Point(q + 2) = {c * r, 0, z(k)};
  Point(q + 3) = {c * r * 0.8, c * r * 0.8, z(k)};
  Point(q + 4) = {0, c * r, z(k)};
  Point(q + 5) = {r, 0, z(k)};
  Point(q + 6) = {r * Sqrt(0.5), r * Sqrt(0.5), z(k)};
  Point(q + 7) = {0, r, z(k)};
  Line(q + 1) = {q + 1, q + 2}; Line(q + 2) = {q + 2, q + 3}; Line(q + 3) = {q + 4, q + 3}; Line(q + 4) = {q + 1, q + 4};
  Line(q + 5) = {q + 2, q + 5}; Line(q + 6) = {q + 3, q + 6}; Line(q + 7) = {q + 4, q + 7};
  Circle(q + 8) = {q + 5, q + 1, q + 6}; Circle(q + 9) = {q + 7, q + 1, q + 6};
  Curve Loop(q + 1) = {q + 1, q + 2, -(q + 3), -(q + 4)};
  Curve Loop(q + 2) = {q + 5, q + 8, -(q + 6), -(q + 2)};
  Curve Loop(q + 3) = {q + 7, q + 9, -(q + 6), -(q + 3)};
  Plane Surface(q + 1) = {q + 1}; Plane Surface(q + 2) = {q + 2}; Plane Surface(q + 3) = {q + 3};
EndFor
layers() = {4, 3};
For k In {0:1}
  q = 100 * k; v = 1000 + 100 * k;
  For i In {1:7}
    Line(v + i) = {q + i, q + 100 + i};
    Transfinite Curve{v + i} = Ceil(layers(k) * n / 2) + 1 Using Progression (k == 0 ? 1.1 : 1.35);
  EndFor
  // sides: start and end points of the lines of the section
  a() = {1, 2, 4, 1, 2, 3, 4, 5, 7}; b() = {2, 3, 3, 4, 5, 6, 7, 6, 6};
  For i In {1:9}
    Curve Loop(v + i) = {q + i, v + b(i - 1), -(q + 100 + i), -(v + a(i - 1))};
    Surface(v + i) = {v + i};
    Transfinite Surface{v + i}; Recombine Surface{v + i};
  EndFor
  Surface Loop(v + 1) = {q + 1, q + 101, v + 1, v + 2, v + 3, v + 4};
  Surface Loop(v + 2) = {q + 2, q + 102, v + 5, v + 8, v + 6, v + 2};
  Surface Loop(v + 3) = {q + 3, q + 103, v + 7, v + 9, v + 6, v + 3};
  For i In {1:3}
    Volume(v + i) = {v + i};
    Transfinite Volume{v + i};
  EndFor
EndFor
Transfinite Curve{1:9, 101:109, 201:209} = n + 1;
Transfinite Surface{1:3, 101:103, 201:203}; Recombine Surface{1:3, 101:103, 201:203};
Physical Volume("foot") = {1001:1003}; Physical Volume("head") = {1101:1103};
Physical Surface("middle") = {1:3}; Physical Surface("joint") = {101:103}; Physical Surface("end") = {201:203};
Physical Surface("ymin") = {1001, 1005, 1101, 1105}; Physical Surface("xmin") = {1004, 1007, 1104, 1107};
Mesh.ElementOrder = 2;
