// A snap fit, a slice of it: an arm with a round nose below its tip, and a base with a round lip on which the nose lands. All of hexahedra.
DefineConstant[ mesh_size = 1 ];
SetFactory("Built-in");
n = Ceil(1 / mesh_size);
w = 0.05;

// The arm: length 1, thickness 0.1; the nose is an arc of the chord 0.2 and the height 0.06.
r = (0.1^2 + 0.06^2) / (2 * 0.06);
Point(1) = {0, 0, 0};
Point(2) = {0.8, 0, 0};
Point(3) = {1, 0, 0};
Point(4) = {0, 0.1, 0};
Point(5) = {0.8, 0.1, 0};
Point(6) = {1, 0.1, 0};
Point(7) = {0.9, r - 0.06, 0};
Line(1) = {1, 2};
Circle(2) = {2, 7, 3};
Line(3) = {4, 5};
Line(4) = {5, 6};
Line(5) = {1, 4};
Line(6) = {2, 5};
Line(7) = {3, 6};
Curve Loop(1) = {1, 6, -3, -5};
Curve Loop(2) = {2, 7, -4, -6};
// The base, 0.15 thick, its upper side at y = -0.07, the crest of the lip at -0.01.
For i In {0:3}
  x = 1.05 + ((i == 0) ? 0 : (i == 1) ? 0.1 : (i == 2) ? 0.3 : 0.6);
  Point(11 + i) = {x, -0.22, 0};
  Point(21 + i) = {x, -0.07, 0};
  Line(31 + i) = {11 + i, 21 + i};
EndFor
Point(30) = {1.25, -0.01 - r, 0};
Line(11) = {11, 12};
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(21) = {21, 22};
Circle(22) = {22, 30, 23};
Line(23) = {23, 24};
For i In {1:3}
  Curve Loop(10 + i) = {10 + i, 31 + i, -(20 + i), -(30 + i)};
EndFor
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(11) = {11};
Plane Surface(12) = {12};
Plane Surface(13) = {13};
Transfinite Curve{1, 3} = 12 * n + 1;
Transfinite Curve{2, 4} = 30 * n + 1;
Transfinite Curve{5, 6, 7} = 2 * n + 1;
Transfinite Curve{11, 21} = 3 * n + 1;
Transfinite Curve{12, 22} = 20 * n + 1;
Transfinite Curve{13, 23} = 4 * n + 1;
Transfinite Curve{31:34} = 2 * n + 1;
Transfinite Surface{1, 2, 11:13};
Recombine Surface{1, 2, 11:13};
arm[] = Extrude {0, 0, w} { Surface{1, 2}; Layers{1}; Recombine; };
base[] = Extrude {0, 0, w} { Surface{11:13}; Layers{1}; Recombine; };
Physical Volume("arm", 1) = {arm[1], arm[7]};
Physical Surface("clamp", 11) = {arm[5]};
Physical Surface("nose", 12) = {arm[8]};
Physical Surface("arm sides", 13) = {1, 2, arm[0], arm[6]};
Physical Volume("base", 2) = {base[1], base[7], base[13]};
Physical Surface("ground", 21) = {base[2], base[8], base[14]};
Physical Surface("lip", 22) = {base[10]};
Physical Surface("floor", 23) = {base[4], base[16]};
Physical Surface("base sides", 24) = {11:13, base[0], base[6], base[12]};
