// A hexagonal nut with a bore and chamfers that are parts of a cone.
SetFactory("OpenCASCADE");
For k In {0:5}
  Point(k+1) = {10*Cos(k*Pi/3), 10*Sin(k*Pi/3), 0};
EndFor
For k In {0:5}
  Line(k+1) = {k+1, (k+1)%6+1};
EndFor
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};
e() = Extrude {0, 0, 8} { Surface{1}; };
Cone(2) = {0, 0, 0, 0, 0, 13, 15, 4};
BooleanIntersection(3) = { Volume{e(1)}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0, 0, -1, 0, 0, 10, 5};
BooleanDifference(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
