//! Spheres and difference pictures, on the CPU.
