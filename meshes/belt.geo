// A belt (thickness 0.05) on the upper quarter of a drum (half a ring), width 0.1.
DefineConstant[ n = 16 ];
SetFactory("Built-in");
w = 0.1; t = 0.05; r = 0.8; pi = Pi;
Point(1) = {0,0,0};
// drum: half a ring from 0 to 180 degrees
Point(2) = {1,0,0}; Point(3) = {0,1,0}; Point(4) = {-1,0,0};
Point(5) = {r,0,0}; Point(6) = {0,r,0}; Point(7) = {-r,0,0};
Circle(1) = {2,1,3}; Circle(2) = {3,1,4};
Circle(3) = {5,1,6}; Circle(4) = {6,1,7};
Line(5) = {5,2}; Line(6) = {6,3}; Line(7) = {7,4};
Curve Loop(1) = {5,1,-6,-3}; Plane Surface(1) = {1};
Curve Loop(2) = {6,2,-7,-4}; Plane Surface(2) = {2};
// belt: from 45 to 135 degrees
c = Sqrt(0.5);
Point(11) = {c,c,0}; Point(12) = {-c,c,0};
Point(13) = {(1+t)*c,(1+t)*c,0}; Point(14) = {-(1+t)*c,(1+t)*c,0};
Circle(11) = {11,1,12}; Circle(12) = {13,1,14};
Line(13) = {11,13}; Line(14) = {12,14};
Curve Loop(3) = {13,12,-14,-11}; Plane Surface(3) = {3};
Transfinite Curve{1,2,3,4} = n + 1;
Transfinite Curve{5,6,7} = 2;
Transfinite Curve{11,12} = n + 8;
Transfinite Curve{13,14} = 2;
Transfinite Surface{1,2,3};
Recombine Surface{1,2,3};
d[] = Extrude {0,0,w} { Surface{1,2}; Layers{1}; Recombine; };
b[] = Extrude {0,0,w} { Surface{3}; Layers{1}; Recombine; };
Printf("%g %g %g %g %g %g | %g %g %g %g %g %g", d[0],d[1],d[2],d[3],d[4],d[5], d[6],d[7],d[8],d[9],d[10],d[11]);
Physical Volume("drum") = {d[1], d[7]};
Physical Volume("belt") = {b[1]};
Physical Surface("drum_outside") = {d[3], d[9]};
Physical Surface("drum_inside") = {d[5], d[11]};
Physical Surface("drum_sides") = {1, 2, d[0], d[6]};
Physical Surface("belt_inside") = {b[5]};
Physical Surface("belt_end") = {b[2]};
Physical Surface("belt_anchor") = {b[4]};
Physical Surface("belt_sides") = {3, b[0]};
