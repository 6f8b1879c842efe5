// A cup with slots in its wall.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 22, 15};
Cylinder(2) = {0, 0, 5, 0, 0, 20, 12};
Torus(3) = {0, 0, 5, 10, 2};
Cylinder(4) = {0, 0, 3, 0, 0, 3, 10};
BooleanDifference(5) = { Volume{1}; Delete; }{ Volume{2}; Volume{3}; Volume{4}; Delete; };
Box(6) = {-20, -2.5, 12, 40, 5, 12};
Cylinder(7) = {0, -20, 12, 0, 40, 0, 3};
BooleanDifference(8) = { Volume{5}; Delete; }{ Volume{6}; Volume{7}; Delete; };
