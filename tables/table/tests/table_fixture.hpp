/// A small table, built once for all tests.
#pragma once

#include <filesystem>
#include <string>

#include "hts/error.hpp"
#include "tables/sharing/table_parts.hpp"

namespace hts::tables::testing {

/// Rough aluminium at three wavelengths, polarised, tolerance 1e-2.
[[nodiscard]] const TableJob& small_job();
[[nodiscard]] const spectral::Reflectance& small_exact();
[[nodiscard]] const Table& small_table();
/// Its bytes.
[[nodiscard]] const std::string& small_bytes();

/// What `action` throws as hts::Error, "" if nothing.
template <class Action>
[[nodiscard]] std::string error_of(Action&& action) {
    try {
        static_cast<void>(action());
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace hts::tables::testing
