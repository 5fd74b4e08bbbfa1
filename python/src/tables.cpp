// hts.Table, hts.read and the files of other programs.
#include "evaluation.hpp"
#include "module.hpp"

#include <filesystem>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include "hts/error.hpp"
#include "spectral/text/output.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/brdf_file.hpp"
#include "tables/formats/measured_model.hpp"
#include "tables/formats/writers/write_brdf.hpp"
#include "tables/table/build_table.hpp"
#include "tables/table/table.hpp"

namespace hts::python {
namespace {

using spectral::WavelengthGrid;
using tables::Table;

/// A table, and the bytes of its file where it has none yet.
struct PyTable {
    Table table;
    std::string bytes, path;
};

PyTable built(const PyMaterial& material, const std::vector<double>& wavelengths, double tolerance,
              bool polarised, std::size_t largest_bytes) {
    const auto grid = WavelengthGrid::from_micrometres(wavelengths);
    const PyMaterial of = material.sampled(grid);
    const auto exact = of.at(grid, {1e-9});
    const tables::TableSource source{of.material().name(), of.description(), ""};
    const tables::TableRequest request{tolerance, 1, polarised, largest_bytes};
    const nb::gil_scoped_release others_may_run;
    std::string bytes = tables::finished_table(exact, source, tables::plan_table(exact, request),
                                               tables::computed_slices(exact));
    return {Table::from_bytes(bytes, source.name), bytes, ""};
}

nb::dict error_of(const tables::TableError& error) {
    nb::dict result;
    result["median"] = error.median;
    result["percentile_99"] = error.percentile_99;
    result["largest"] = error.largest;
    result["pairs"] = error.pairs;
    result["seed"] = error.seed;
    return result;
}

void save(const PyTable& table, const std::string& path) {
    spectral::write_file(path, table.bytes.empty() ? spectral::read_text_file(table.path) : table.bytes);
}

/// Writes a file of another program; what its readers make of it, as JSON.
std::string export_source(const tables::Source& source, const tables::WrittenFormat& format,
                          tables::FileRequest request) {
    const nb::gil_scoped_release others_may_run;
    return tables::write_brdf(source, format, request).json();
}

tables::FileRequest request_of(const std::string& path, bool colour, const std::optional<std::string>& basis,
                               std::optional<int> depth, std::optional<double> specular_spread,
                               std::size_t pairs, std::uint64_t seed) {
    return {.path = path,
            .colour = colour,
            .basis = basis,
            .depth = depth,
            .specular_spread = specular_spread,
            .pairs = pairs,
            .seed = seed};
}

std::string export_material(const PyMaterial& material, const std::string& path, const std::string& format,
                            const std::optional<std::vector<double>>& wavelengths, bool colour,
                            const std::optional<std::string>& basis, std::optional<int> depth,
                            std::optional<double> specular_spread, std::size_t pairs, std::uint64_t seed,
                            const std::string& outside) {
    const auto& written = tables::written_format(format);
    std::optional<WavelengthGrid> grid;
    if (wavelengths) grid = WavelengthGrid::from_micrometres(*wavelengths);
    const auto otherwise = tables::wavelengths_to_write(material.material(), written, colour);
    const tables::Source source{material.at(grid.value_or(otherwise), how_from(1e-6, outside, false)),
                                material.material().properties().channels};
    return export_source(source, written,
                         request_of(path, colour, basis, depth, specular_spread, pairs, seed));
}

std::string export_table(const PyTable& table, const std::string& path, const std::string& format,
                         bool colour, const std::optional<std::string>& basis, std::optional<int> depth,
                         std::optional<double> specular_spread, std::size_t pairs, std::uint64_t seed) {
    return export_source({table.table.reflectance()}, tables::written_format(format),
                         request_of(path, colour, basis, depth, specular_spread, pairs, seed));
}

}  // namespace

PyMaterial material_of_reflectance(const spectral::Reflectance& reflectance, std::vector<std::string> notes,
                                   const std::string& model, const std::string& source,
                                   std::vector<std::string> channels) {
    return PyMaterial{tables::material_of_file(reflectance, std::move(notes), std::move(channels))
                          .named(reflectance.name(), model, source)};
}

PyMaterial material_of_any_file(const std::string& path, const std::string& format,
                                std::optional<std::vector<double>> wavelengths) {
    if (path.ends_with(".json") && format.empty()) {
        return PyMaterial{spectral::read_material(path, tables::models_with_files()),
                          spectral::read_text_file(path),
                          {},
                          std::filesystem::absolute(path).parent_path().string()};
    }
    std::optional<WavelengthGrid> grid;
    if (wavelengths) grid = WavelengthGrid::from_micrometres(*wavelengths);
    const nb::gil_scoped_release others_may_run;
    auto file = tables::read_brdf(path, {grid, format});
    return material_of_reflectance(file.brdf, std::move(file.notes), "measured", file.format,
                                   std::move(file.channels));
}

void bind_tables(nb::module_& module) {
    nb::class_<PyTable> table{module, "Table"};
    table.def_static(
        "open",
        [](const std::string& path) {
            return PyTable{Table::open(path), "", path};
        },
        nb::arg("path"));
    table.def_prop_ro("name", [](const PyTable& self) { return self.table.name(); });
    table.def_prop_ro("wavelengths",
                      [](const PyTable& self) { return array_of(self.table.wavelengths().micrometres()); });
    table.def_prop_ro("tolerance", [](const PyTable& self) { return self.table.info().tolerance; });
    table.def_prop_ro(
        "error", [](const PyTable& self) { return error_of(self.table.info().error); },
        nb::for_getter(nb::sig("def error(self) -> dict[str, float]")));
    table.def_prop_ro("bytes", [](const PyTable& self) { return self.table.bytes(); });
    table.def_prop_ro("polarised", [](const PyTable& self) { return self.table.properties().polarised; });
    table.def("material", [](const PyTable& self) {
        return material_of_reflectance(self.table.reflectance(), {}, "table", "a lookup table of hts");
    });
    table.def(
        "check",
        [](const PyTable& self, const PyMaterial& exact, std::uint64_t pairs, std::uint64_t seed) {
            const auto of = exact.at(self.table.wavelengths(), {1e-9});
            tables::TableError error;
            {
                const nb::gil_scoped_release others_may_run;
                error = tables::table_error(self.table.reflectance(), of, pairs, seed);
            }
            return error_of(error);
        },
        HTS_ANY("check(self, exact: Material, pairs: int, seed: int)"), nb::arg("exact"), nb::arg("pairs"),
        nb::arg("seed"));
    table.def("save", &save, nb::arg("path"));
    table.def("_export", &export_table, nb::arg("path"), nb::arg("format"), nb::arg("colour"),
              nb::arg("basis").none(), nb::arg("depth").none(), nb::arg("specular_spread").none(),
              nb::arg("pairs"), nb::arg("seed"));
    module.def("_export", &export_material, nb::arg("material"), nb::arg("path"), nb::arg("format"),
               nb::arg("wavelengths").none(), nb::arg("colour"), nb::arg("basis").none(),
               nb::arg("depth").none(), nb::arg("specular_spread").none(), nb::arg("pairs"), nb::arg("seed"),
               nb::arg("outside"));

    module.def("_read", &material_of_any_file, nb::arg("path"), nb::arg("format") = "",
               nb::arg("wavelengths") = nb::none());
    module.def("_build_table", &built, nb::arg("material"), nb::arg("wavelengths"), nb::arg("tolerance"),
               nb::arg("polarised"), nb::arg("largest_bytes"));
    module.def(
        "formats",
        [] {
            nb::list names;
            for (const auto& format : tables::readable_formats())
                names.append(nb::make_tuple(format.name, format.what));
            return names;
        },
        nb::sig("def formats() -> list[tuple[str, str]]"),
        "Files of other programs that `read` knows, each with a line of what it is.");
    module.def(
        "written_formats",
        [] {
            nb::list names;
            for (const auto& format : tables::written_formats())
                names.append(nb::make_tuple(format.name, format.what));
            return names;
        },
        nb::sig("def written_formats() -> list[tuple[str, str]]"),
        "Files of other programs that `export` writes, each with a line of what it is.");
}

}  // namespace hts::python
