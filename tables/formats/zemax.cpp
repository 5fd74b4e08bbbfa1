#include "tables/formats/zemax.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/text/output.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/points/tokens.hpp"
#include "tables/formats/specular_box.hpp"

namespace hts::tables {

using spectral::same_letters;

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr std::size_t most_angles = 100'000;  // per axis
constexpr std::string_view wavelength_comment = "# wavelength_um ";

// The grid's cells cut into four along the polar angle and two along the azimuth: their
// middles, with solid angles.
struct FineGrid {
    AngularGrid grid;
    std::vector<double> solid_angle;  // per azimuth and polar angle
};

std::vector<double> cut(const std::vector<double>& nodes, int pieces, std::vector<double>& widths) {
    std::vector<double> middles;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        const double width = (nodes[i] - nodes[i - 1]) / pieces;
        for (int k = 0; k < pieces; ++k) {
            middles.push_back(nodes[i - 1] + (k + 0.5) * width);
            widths.push_back(width * degree);
        }
    }
    return middles;
}

FineGrid fine(const AngularGrid& coarse) {
    FineGrid result{coarse, {}};
    std::vector<double> turns, radii;
    result.grid.azimuth = cut(coarse.azimuth, 2, turns);
    result.grid.polar = cut(coarse.polar, 4, radii);
    for (const double turn : turns) {
        for (std::size_t r = 0; r < radii.size(); ++r) {
            result.solid_angle.push_back((coarse.symmetric ? 2 : 1) * turn * radii[r] *
                                         std::sin(result.grid.polar[r] * degree));
        }
    }
    return result;
}

// Reflectance per angle of incidence and wavelength.
std::vector<double> reflectances(const AngularGrid& coarse, const spectral::Reflectance& brdf) {
    const FineGrid cells = fine(coarse);
    const std::size_t wavelengths = brdf.wavelengths().size();
    const std::vector<double> values = values_on(cells.grid, brdf);
    std::vector<double> sums(coarse.theta_i.size() * wavelengths, 0);
    for (std::size_t node = 0; node < cells.grid.size(); ++node) {
        const auto pair = cells.grid.pair(node);
        if (!pair) continue;
        const double share = cells.solid_angle[node % cells.solid_angle.size()] * pair->out.cos_theta();
        for (std::size_t k = 0; k < wavelengths; ++k)
            sums[node / cells.solid_angle.size() * wavelengths + k] += share * values[node * wavelengths + k];
    }
    return sums;
}

void append_list(std::string& text, const char* name, const std::vector<double>& angles) {
    text.append(name).append(" ").append(std::to_string(angles.size())).append("\n");
    for (std::size_t i = 0; i < angles.size(); ++i) {
        if (i > 0) text += ' ';
        append_rounded(text, angles[i], 9);
    }
    text += '\n';
}

///   wavelength_um   none for a file of tristimulus values
std::string header(const AngularGrid& grid, const std::string& name, std::optional<double> wavelength_um) {
    std::string text = "# ";
    text.append(spectral::in_quotes(name)).append(", BRDF in 1/sr without the cosine, written by hts\n");
    if (wavelength_um) text.append(wavelength_comment).append(shortest(*wavelength_um)).append("\n");
    text.append("Source Generated\nSymmetry ");
    text.append(grid.symmetric ? "PlaneSymmetrical" : "Asymmetrical");
    text.append("\nSpectralContent ")
        .append(wavelength_um ? "Monochrome" : "XYZ")
        .append("\nScatterType BRDF\nSampleRotation 1\n0\n");
    append_list(text, "AngleOfIncidence", grid.theta_i);
    append_list(text, "ScatterAzimuth", grid.azimuth);
    append_list(text, "ScatterRadial", grid.polar);
    return text + "\n";
}

// What stands in front of the data.
struct Header {
    AngularGrid grid;
    bool tristimulus = false;
};

std::vector<double> take_list(Tokens& tokens, std::string_view keyword, const char* quantity) {
    tokens.take_word(keyword);
    const std::size_t count = tokens.take_count(quantity, most_angles);
    return tokens.take_numbers(quantity, count);
}

void take_choice(Tokens& tokens, std::string_view keyword, std::string_view choice, const char* reason) {
    tokens.take_word(keyword);
    if (!same_letters(tokens.next(), choice)) {
        throw tokens.error(
            std::string{keyword}.append(" ").append(tokens.next().substr(0, 40)).append(": ").append(reason));
    }
    tokens.take();
}

Header take_header(Tokens& tokens) {
    Header header;
    header.grid.axis = PolarAxis::mirror;
    tokens.take_word("Source");
    tokens.take();
    tokens.take_word("Symmetry");
    header.grid.symmetric = same_letters(tokens.next(), "PlaneSymmetrical");
    if (!header.grid.symmetric && !same_letters(tokens.next(), "Asymmetrical") &&
        !same_letters(tokens.next(), "Asymmetrical4D"))
        throw tokens.error("Symmetry: must be PlaneSymmetrical or Asymmetrical");
    tokens.take();
    tokens.take_word("SpectralContent");
    header.tristimulus = same_letters(tokens.next(), "XYZ");
    if (!header.tristimulus && !same_letters(tokens.next(), "Monochrome"))
        throw tokens.error("SpectralContent: must be Monochrome or XYZ");
    tokens.take();
    take_choice(tokens, "ScatterType", "BRDF", "only reflection can be read");
    take_choice(tokens, "SampleRotation", "1", "only isotropic surfaces, with one rotation, can be read");
    tokens.take_number("rotation of the sample");
    header.grid.theta_i = take_list(tokens, "AngleOfIncidence", "angle of incidence");
    header.grid.azimuth = take_list(tokens, "ScatterAzimuth", "azimuth");
    header.grid.polar = take_list(tokens, "ScatterRadial", "radial angle");
    try {
        header.grid.check();
    } catch (const Error& failure) {
        throw tokens.error(failure.what());
    }
    return header;
}

// One value per node.
std::vector<double> take_block(Tokens& tokens, std::string_view keyword, const AngularGrid& grid) {
    tokens.take_word(keyword);
    tokens.take_word("DataBegin");
    std::vector<double> values;
    for (std::size_t i = 0; i < grid.theta_i.size(); ++i) {
        tokens.take_word("TIS");
        tokens.take_number("TIS");
        for (std::size_t k = 0; k < grid.azimuth.size(); ++k) {
            for (std::size_t r = 0; r < grid.polar.size(); ++r) values.push_back(tokens.take_value("BRDF"));
        }
    }
    tokens.take_word("DataEnd");
    return values;
}

// Z, Y and X of each node.
std::vector<double> take_tristimulus(Tokens& tokens, const AngularGrid& grid) {
    const auto X = take_block(tokens, "TristimulusX", grid), Y = take_block(tokens, "TristimulusY", grid),
               Z = take_block(tokens, "TristimulusZ", grid);
    std::vector<double> values;
    for (std::size_t i = 0; i < X.size(); ++i) values.insert(values.end(), {Z[i], Y[i], X[i]});
    return values;
}

std::optional<spectral::WavelengthGrid> commented_wavelength(std::string_view text, const std::string& name) {
    const auto at = text.find(wavelength_comment);
    if (at == std::string_view::npos) return std::nullopt;
    text.remove_prefix(at + wavelength_comment.size());
    return spectral::located(name, [&] {
        return spectral::WavelengthGrid::from_micrometres(
            {spectral::number_in(text.substr(0, text.find('\n')))});
    });
}

}  // namespace

AngularGrid zemax_grid(double box) {
    AngularGrid grid;
    grid.axis = PolarAxis::mirror;
    for (double theta = 0; theta < 40; theta += 2.5) grid.theta_i.push_back(theta);
    for (double theta = 40; theta < 90; theta += 1) grid.theta_i.push_back(theta);
    for (double azimuth = 0; azimuth <= 180; azimuth += 10) grid.azimuth.push_back(azimuth);
    grid.polar = {0, 0.1, 0.2, 0.5};
    for (double r = 1; r < 20; r += 1) grid.polar.push_back(r);
    for (double r = 20; r < 60; r += 2) grid.polar.push_back(r);
    for (double r = 60; r <= 170; r += 5) grid.polar.push_back(r);
    if (box > 0) {
        const double edge = specular_box_half_angle(box) / degree;
        grid.polar.insert(grid.polar.end(), {edge * (1 - 1e-3), edge * (1 + 1e-3)});
        std::ranges::sort(grid.polar);
        grid.polar.erase(std::unique(grid.polar.begin(), grid.polar.end()), grid.polar.end());
    }
    return grid;
}

namespace {

/// Values on a grid that fits the surface, and what each angle of incidence reflects.
class Gridded {
  public:
    Gridded(const spectral::Reflectance& brdf, AngularGrid grid)
        : grid_{std::move(grid)}, channels_{brdf.size()} {
        if (!brdf.properties().isotropic) {
            throw Error{brdf.name() +
                        ": depends on the azimuth of the light, which OpticStudio's BSDF does not know"};
        }
        grid_.check();
        if (!is_plane_symmetric(brdf)) grid_ = without_symmetry(std::move(grid_));
        values_ = values_on(grid_, brdf, BelowHorizon::continued);
        tis_ = reflectances(grid_, brdf);
    }

    [[nodiscard]] const AngularGrid& grid() const noexcept { return grid_; }
    /// The numbers of a channel between its name and DataEnd.
    [[nodiscard]] std::string block(const std::string& name, std::size_t channel) const {
        std::string text = name + "\nDataBegin\n";
        std::size_t node = 0;
        for (std::size_t i = 0; i < grid_.theta_i.size(); ++i) {
            text += "TIS ";
            append_rounded(text, tis_[i * channels_ + channel]);
            text += '\n';
            for (std::size_t a = 0; a < grid_.azimuth.size(); ++a) {
                for (std::size_t r = 0; r < grid_.polar.size(); ++r, ++node) {
                    append_rounded(text, values_[node * channels_ + channel]);
                    text += r + 1 < grid_.polar.size() ? ' ' : '\n';
                }
            }
        }
        return text + "DataEnd\n";
    }

  private:
    AngularGrid grid_;
    std::size_t channels_;
    std::vector<double> values_, tis_;
};

}  // namespace

std::vector<std::string> zemax_texts(const spectral::Reflectance& brdf, AngularGrid grid) {
    const Gridded gridded{brdf, std::move(grid)};
    std::vector<std::string> texts;
    for (std::size_t k = 0; k < brdf.size(); ++k)
        texts.push_back(header(gridded.grid(), brdf.name(), brdf.wavelengths().micrometres()[k]) +
                        gridded.block("Monochrome", k));
    return texts;
}

std::string zemax_colour_text(const spectral::Reflectance& xyz, AngularGrid grid) {
    require_three_channels(xyz);
    const Gridded gridded{xyz, std::move(grid)};
    return header(gridded.grid(), xyz.name(), std::nullopt) + gridded.block("TristimulusX", 2) +
           gridded.block("TristimulusY", 1) + gridded.block("TristimulusZ", 0);
}

static ZemaxFile one_file(std::string_view text, const std::string& name,
                          const std::optional<spectral::WavelengthGrid>& wavelengths) {
    Tokens tokens{text, name};
    const Header header = take_header(tokens);
    std::vector<double> values = header.tristimulus ? take_tristimulus(tokens, header.grid)
                                                    : take_block(tokens, "Monochrome", header.grid);
    if (!tokens.at_end()) throw tokens.error("text after DataEnd, which no reader would see");
    auto channels = wavelengths          ? wavelengths
                    : header.tristimulus ? rgb_wavelengths()
                                         : commented_wavelength(text, name);
    if (!channels) throw Error{name + ": does not say its wavelength, which must be given"};
    if (channels->size() != (header.tristimulus ? 3U : 1U)) {
        throw Error{name + ": holds " + (header.tristimulus ? "3 channels" : "1 wavelength") + ", not " +
                    std::to_string(channels->size())};
    }
    ZemaxFile file{gridded_brdf(name, *channels, header.grid, std::move(values))};
    if (header.tristimulus && !wavelengths) file.channels = xyz_channels();
    if (tokens.negative().count > 0) file.notes.push_back(tokens.negative().text());
    return file;
}

spectral::Reflectance zemax_brdf(std::string_view text, const std::string& name,
                                 const std::optional<spectral::WavelengthGrid>& wavelengths) {
    return one_file(text, name, wavelengths).brdf;
}

std::vector<spectral::TextFile> zemax_files(const spectral::Reflectance& brdf,
                                            const std::filesystem::path& path, AngularGrid grid) {
    const auto wavelengths = brdf.wavelengths().micrometres();
    if (wavelengths.size() > 1 && path.extension() != ".json") {
        throw Error{path.string() + ": one file holds one wavelength; for " +
                    std::to_string(wavelengths.size()) + " name an index that ends in .json"};
    }
    const std::vector<std::string> texts = zemax_texts(brdf, std::move(grid));
    if (texts.size() == 1 && path.extension() != ".json") return {{path.string(), texts.front()}};
    std::vector<spectral::TextFile> files;
    std::string index = "{\"zemax_files\": [";
    for (std::size_t k = 0; k < texts.size(); ++k) {
        std::string nanometres;
        append_rounded(nanometres, 1000 * wavelengths[k], 9);
        const auto file = path.parent_path() / (path.stem().string() + "_" + nanometres + "nm.bsdf");
        files.push_back({file.string(), texts[k]});
        index.append(k == 0 ? "\n" : ",\n").append("  {\"wavelength_um\": ").append(shortest(wavelengths[k]));
        index.append(", \"file\": ").append(spectral::in_quotes(file.filename().string())).append("}");
    }
    files.push_back({path.string(), index + "\n]}\n"});
    return files;
}

void write_zemax(const spectral::Reflectance& brdf, const std::filesystem::path& path) {
    spectral::write_files(zemax_files(brdf, path));
}

ZemaxFile zemax_file(std::string_view text, const std::filesystem::path& path,
                     const std::optional<spectral::WavelengthGrid>& wavelengths) {
    if (!spectral::trimmed(text).starts_with('{')) return one_file(text, path.string(), wavelengths);
    if (wavelengths) throw Error{path.string() + ": says its wavelengths, which must not be given"};
    const auto index = spectral::JsonValue::parse(std::string{text}, path.string());
    std::vector<spectral::Reflectance> parts;
    std::vector<std::string> notes;
    for (const auto& item : index["zemax_files"].items()) {
        item.require_keys_among({"wavelength_um", "file"});
        const double micrometres = item["wavelength_um"].number();
        const auto part = path.parent_path() / item["file"].text();
        auto found = spectral::located(item.place(), [&] {
            return one_file(spectral::read_text_file(part), part.string(),
                            spectral::WavelengthGrid::from_micrometres({micrometres}));
        });
        parts.push_back(std::move(found.brdf));
        for (const std::string& note : found.notes) notes.push_back(item["file"].text() + ": " + note);
    }
    return {
        spectral::located(path.string(), [&] { return joined(path.string(), std::move(parts)); }), {}, notes};
}

spectral::Reflectance read_zemax(const std::filesystem::path& path,
                                 const std::optional<spectral::WavelengthGrid>& wavelengths) {
    return zemax_file(spectral::read_text_file(path), path, wavelengths).brdf;
}

}  // namespace hts::tables
