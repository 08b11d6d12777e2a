"""plait's strand models as solvers of cosseratbench, through plait's C API."""
