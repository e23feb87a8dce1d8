//! Plots and strips as SVG or PNG, shared by the command line and the window.
