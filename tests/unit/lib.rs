//! A package needs a library or a program.
