// A round post that is bent by a quarter turn, with a ball at its end, on a plate.
SetFactory("OpenCASCADE");
Box(1) = {-9, -9, 0, 18, 18, 3};
Cylinder(2) = {0, 0, 3, 0, 0, 9, 2};
Torus(3) = {5, 0, 12, 5, 2, Pi/2};
Rotate {{1, 0, 0}, {5, 0, 12}, Pi/2} { Volume{3}; }
Rotate {{0, 1, 0}, {5, 0, 12}, -Pi/2} { Volume{3}; }
Cylinder(4) = {5, 0, 17, 8, 0, 0, 2};
Sphere(5) = {14, 0, 17, 4};
BooleanUnion(6) = { Volume{1}; Delete; }{ Volume{2}; Volume{3}; Volume{4}; Volume{5}; Delete; };
