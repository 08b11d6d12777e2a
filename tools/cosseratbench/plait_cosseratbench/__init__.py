"""plait's model `articulated` as a solver of cosseratbench, through plait's C API."""
