// A disc of radius 1 and height 0.5 in hexahedra: a square in the middle and four sectors around it.
q = 0.4;
Point(1) = {0, 0, 0};
For i In {0:3}
  Point(10 + i) = {q * Cos(i * Pi/2 + Pi/4), q * Sin(i * Pi/2 + Pi/4), 0};
  Point(20 + i) = {Cos(i * Pi/2 + Pi/4), Sin(i * Pi/2 + Pi/4), 0};
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Line(10 + i) = {10 + i, 10 + j};
  Circle(20 + i) = {20 + i, 1, 20 + j};
  Line(30 + i) = {10 + i, 20 + i};
EndFor
Curve Loop(1) = {10:13};
Plane Surface(1) = {1};
For i In {0:3}
  j = (i + 1) % 4;
  Curve Loop(i + 2) = {10 + i, 30 + j, -(20 + i), -(30 + i)};
  Plane Surface(i + 2) = {i + 2};
EndFor
DefineConstant[ mesh_size = 0.4 ];
n = Ceil(0.8 / mesh_size);
Transfinite Curve{10:13, 20:23} = n + 1;
Transfinite Curve{30:33} = n + 1;
Transfinite Surface{1:5};
Recombine Surface{1:5};
out() = Extrude{0, 0, 0.5}{ Surface{1:5}; Layers{1}; Recombine; };
Physical Volume("disc") = Volume{:};
e = 1e-3;
bottom() = Surface In BoundingBox{-2, -2, -e, 2, 2, e};
top() = Surface In BoundingBox{-2, -2, 0.5 - e, 2, 2, 0.5 + e};
all() = Boundary{ Volume{:}; };
Physical Surface("bottom") = bottom();
Physical Surface("top") = top();
sides() = CombinedBoundary{ Volume{:}; };
sides() = Abs(sides());
sides() -= bottom();
sides() -= top();
Physical Surface("side") = sides();
