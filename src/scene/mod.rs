//! From the angles a scene shows to the cheapest model within a tolerance.
