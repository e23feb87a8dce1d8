//! What a preset says to each renderer, and what is lost on the way.
