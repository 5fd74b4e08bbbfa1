/// The shader in WGSL, for WebGPU.
#pragma once

#include <string>

namespace hts::tables {

/// The same code, line by line.
///   glsl   as he_torrance.glsl and glsl_text write it: a function's head and a declaration stand in a line
///          each, an `if` of one line has no braces, a `for` has them, and there is no conditional operator
[[nodiscard]] std::string wgsl_of(const std::string& glsl);

}  // namespace hts::tables
