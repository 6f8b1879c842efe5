// A fork with a cross hole and rounded ends on a square foot.
SetFactory("OpenCASCADE");
Box(1) = {-8, -8, 0, 16, 16, 10};
Box(2) = {-8, -8, 10, 16, 16, 14};
Cylinder(3) = {0, -8, 24, 0, 16, 0, 8};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2}; Volume{3}; Delete; };
Box(5) = {-10, -3.5, 12, 20, 7, 30};
Cylinder(6) = {0, -10, 24, 0, 20, 0, 3};
Cylinder(7) = {0, 0, -1, 0, 0, 9, 3};
BooleanDifference(8) = { Volume{4}; Delete; }{ Volume{5}; Volume{6}; Volume{7}; Delete; };
