// A bracket: two walls with a fillet between them, holes and rounded corners.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 40, 30, 4};
Box(2) = {0, 0, 4, 4, 30, 26};
Box(3) = {4, 0, 4, 6, 30, 6};
Cylinder(4) = {10, -1, 10, 0, 32, 0, 6};
BooleanDifference(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
BooleanUnion(6) = { Volume{1}; Delete; }{ Volume{2}; Volume{5}; Delete; };
Cylinder(7) = {22, 8, -1, 0, 0, 6, 3};
Cylinder(8) = {22, 22, -1, 0, 0, 6, 3};
Cylinder(9) = {-1, 15, 19, 6, 0, 0, 5};
BooleanDifference(10) = { Volume{6}; Delete; }{ Volume{7}; Volume{8}; Volume{9}; Delete; };
