// The half x > 0 of a block below z = 0, |x| and |z| up to 4, one cell of 0.02 thick, in hexahedra: cells of mesh_size up to x = 0.1, where a punch
// ends, which grow by a constant ratio near 1.15 outwards and in depth. Boundaries: contact (z = 0), x0, ends, far.
DefineConstant[ mesh_size = 0.002 ];
a = 0.1; L = 4; w = 0.02;
m = Round(a / mesh_size);

// Where layers from `start` to L end, from 0 to 1, the first about a / m
Macro Grow
  heights() = {};
  ones() = {};
  l = (L - start) * m / a;
  k = Round(Log(1 + l * 0.15) / Log(1.15));
  q = 1.15;
  For i In {1:60}
    q = (1 + (q - 1) * l)^(1 / k);
  EndFor
  For i In {1:k}
    heights() += (q^i - 1) / (q^k - 1);
    ones() += 1;
  EndFor
Return

Point(1) = {0, 0, 0};
under() = Extrude{a, 0, 0}{ Point{1}; Layers{m}; };
start = a;
Call Grow;
beside() = Extrude{L - a, 0, 0}{ Point{under(0)}; Layers{ones(), heights()}; };
inner() = Extrude{0, w, 0}{ Curve{under(1)}; Layers{1}; Recombine; };
outer() = Extrude{0, w, 0}{ Curve{beside(1)}; Layers{1}; Recombine; };
start = 0;
Call Grow;
Extrude{0, 0, -L}{ Surface{inner(1), outer(1)}; Layers{ones(), heights()}; Recombine; }
e = 1e-5;
x0() = Surface In BoundingBox{-e, -e, -L - e, e, w + e, e};
ends() = Surface In BoundingBox{-e, -e, -L - e, L + e, e, e};
ends() += Surface In BoundingBox{-e, w - e, -L - e, L + e, w + e, e};
far() = CombinedBoundary{ Volume{:}; };
far() = Abs(far());
far() -= {inner(1), outer(1), x0(), ends()};
Physical Volume("block") = Volume{:};
Physical Surface("contact") = {inner(1), outer(1)};
Physical Surface("x0") = x0();
Physical Surface("ends") = ends();
Physical Surface("far") = far();
