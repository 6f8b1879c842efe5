// A ball with a cross hole on a tapered shaft.
SetFactory("OpenCASCADE");
Cone(1) = {0, 0, 0, 0, 0, 14, 7, 4};
Sphere(2) = {0, 0, 20, 9};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {-12, 0, 20, 24, 0, 0, 3};
Cylinder(5) = {0, 0, -1, 0, 0, 9, 3};
BooleanDifference(6) = { Volume{3}; Delete; }{ Volume{4}; Volume{5}; Delete; };
