#include "cli/io/figure_files.hpp"

#include "cli/io/table_writer.hpp"
#include "spectral/output/gnuplot.hpp"
#include "spectral/text/run_files.hpp"

namespace hts::cli {
namespace {

/// Figures of one run may show the same numbers.
void write_table(const std::filesystem::path& path, Format format, const validation::FigureTable& numbers) {
    if (auto* run = spectral::RunFiles::of_process(); run != nullptr && run->is_complete(path.string()))
        return;
    Output output{path.string()};
    TableWriter table{output, format, numbers.columns};
    std::string text;
    for (const auto& values : numbers.rows) {
        TableWriter::Row row{table, text};
        for (const double value : values) row.number(value);
        row.end();
    }
    table.add(text);
    table.finish();
    output.commit();
}

}  // namespace

std::filesystem::path write_figure(const std::filesystem::path& folder, const validation::Figure& figure,
                                   bool json) {
    auto picture = folder / (figure.stem + ".svg");
    output::require_gnuplot(picture.string());
    for (const validation::FigureTable& table : figure.tables) {
        write_table(folder / (table.stem + ".csv"), Format::csv, table);
        if (json) write_table(folder / (table.stem + ".json"), Format::json, table);
    }
    output::draw(picture.string(), figure.script);
    return picture;
}

}  // namespace hts::cli
