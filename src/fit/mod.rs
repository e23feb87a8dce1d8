//! Parameters of each model for a measured metal, and conversions between parameterisations.
