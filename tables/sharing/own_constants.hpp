/// Optical constants that a table takes along.
#pragma once

#include "tables/table/table.hpp"

namespace hts::tables {

/// A source whose keys "index" name no files: each {"file": …} is {"table": …} of its values at the
/// wavelengths of the table and half-way between them, where the table is checked. So a check holds a table
/// against the constants it was built from, wherever it is made and whatever has become of their file. A
/// source without such keys stays as it is. hts::Error as reading the material has it.
[[nodiscard]] TableSource with_own_constants(TableSource source, const spectral::WavelengthGrid& wavelengths);

}  // namespace hts::tables
