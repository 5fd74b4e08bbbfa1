#include "tables/formats/points/lighttools.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/points/tokens.hpp"

namespace hts::tables {
namespace {

using spectral::same_letters;
using spectral::WavelengthGrid;

constexpr std::size_t most_angles = 100'000;
constexpr double azimuth_of_light = 90;  // [deg]

struct Header {
    bool symmetric = false, tristimulus = false;
    std::vector<double> azimuth, polar;
};

// What stands in front of a block's values.
struct Block {
    double theta_i = 0, phi_i = 0, nanometres = 0;
    bool front = true, reflection = true;
    std::size_t channel = 0;  // Z, Y, X
    std::size_t line = 0;
    std::vector<double> values{};

    [[nodiscard]] std::string name() const {
        return std::string{reflection ? "BRDF" : "BTDF"} + (front ? " Front" : " Back");
    }
};

bool next_is(const Tokens& tokens, std::string_view word) {
    return same_letters(tokens.next(), word);
}

std::vector<double> take_list(Tokens& tokens, const char* quantity) {
    const std::size_t count = tokens.take_count(quantity, most_angles);
    return tokens.take_numbers(quantity, count);
}

Header take_header(Tokens& tokens) {
    Header header;
    while (!next_is(tokens, "DataBegin")) {
        if (tokens.at_end()) throw tokens.error("DataBegin: missing");
        const std::string key{tokens.take()};
        if (same_letters(key, "ScatterAzimuth")) {
            header.azimuth = take_list(tokens, "azimuth");
        } else if (same_letters(key, "ScatterRadial")) {
            header.polar = take_list(tokens, "radial angle");
        } else if (same_letters(key, "Symmetry")) {
            header.symmetric = next_is(tokens, "PlaneSymmetrical");
            tokens.take();
        } else if (same_letters(key, "SpectralContent")) {
            header.tristimulus = next_is(tokens, "XYZ");
            if (!header.tristimulus && !next_is(tokens, "Monochrome"))
                throw tokens.error("SpectralContent: must be Monochrome or XYZ");
            tokens.take();
        }
    }
    tokens.take();
    if (header.azimuth.empty() || header.polar.empty())
        throw tokens.error("ScatterAzimuth and ScatterRadial: must stand before DataBegin");
    return header;
}

std::size_t take_channel(Tokens& tokens) {
    constexpr std::array names{"TrisZ", "TrisY", "TrisX"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!next_is(tokens, names[i])) continue;
        tokens.take();
        return i;
    }
    throw tokens.error("TristimulusValue: must be TrisX, TrisY or TrisZ");
}

bool take_choice(Tokens& tokens, const char* yes, const char* no) {
    const bool chosen = next_is(tokens, yes);
    if (!chosen && !next_is(tokens, no))
        throw tokens.error(std::string{"must be "}.append(yes).append(" or ").append(no));
    tokens.take();
    return chosen;
}

Block take_block(Tokens& tokens, const Header& header) {
    Block block;
    block.line = tokens.line();
    for (;;) {
        const std::string key{tokens.take()};
        if (same_letters(key, "AOI")) {
            block.theta_i = tokens.take_number("AOI");
        } else if (same_letters(key, "POI")) {
            block.phi_i = tokens.take_number("POI");
        } else if (same_letters(key, "Side")) {
            block.front = take_choice(tokens, "Front", "Back");
        } else if (same_letters(key, "Wavelength")) {
            block.nanometres = tokens.take_number("Wavelength");
        } else if (same_letters(key, "ScatterType")) {
            block.reflection = take_choice(tokens, "BRDF", "BTDF");
        } else if (same_letters(key, "TristimulusValue")) {
            block.channel = take_channel(tokens);
        } else if (same_letters(key, "TIS")) {
            tokens.take_number("TIS");
            break;
        } else {
            throw tokens.error(spectral::in_quotes(key.substr(0, 40)) +
                               ": must be AOI, POI, Side, Wavelength, ScatterType, TristimulusValue or TIS");
        }
    }
    for (std::size_t i = 0; i < header.azimuth.size() * header.polar.size(); ++i)
        block.values.push_back(tokens.take_value("BSDF"));
    return block;
}

// Blocks of reflection at the front; the others are counted by name.
std::vector<Block> read_blocks(Tokens& tokens, const Header& header, const std::string& name,
                               std::map<std::string, int>& left_out) {
    std::vector<Block> blocks;
    std::set<std::array<double, 4>> seen;
    while (!next_is(tokens, "DataEnd")) {
        if (tokens.at_end()) throw tokens.error("DataEnd: missing");
        Block block = take_block(tokens, header);
        if (!block.reflection || !block.front) {
            ++left_out[block.name()];
            continue;
        }
        const double channel = header.tristimulus ? static_cast<double>(block.channel) : block.nanometres;
        if (!seen.insert({block.theta_i, block.phi_i, channel, 0}).second) {
            throw Error{name + ":" + std::to_string(block.line) + ": a second block of AOI " +
                        shortest(block.theta_i) + ", POI " + shortest(block.phi_i) + ", " +
                        (header.tristimulus ? "the same tristimulus value" : shortest(channel) + " nm") +
                        ": must be one"};
        }
        blocks.push_back(std::move(block));
    }
    return blocks;
}

}  // namespace

bool is_lighttools_file(std::string_view text) {
    // the keywords are those of OpticStudio's format, but for the blocks
    const auto begin = text.find("DataBegin");
    if (begin == std::string_view::npos) return false;
    const auto words = spectral::words(text.substr(begin, 200));
    return words.size() > 1 && (same_letters(words[1], "AOI") || same_letters(words[1], "POI") ||
                                same_letters(words[1], "Side") || same_letters(words[1], "Wavelength"));
}

ScatterPoints points_of_lighttools(std::string_view text, const std::string& name,
                                   const std::optional<WavelengthGrid>& wavelengths) {
    Tokens tokens{text, name};
    const Header header = take_header(tokens);
    std::map<std::string, int> left_out;
    const std::vector<Block> blocks = read_blocks(tokens, header, name, left_out);
    std::vector<std::string> others;
    others.reserve(left_out.size());
    for (const auto& [kind, count] : left_out) others.push_back(std::to_string(count) + " of " + kind);
    if (blocks.empty()) {
        throw Error{name + ": no block of reflection at the front" +
                    (others.empty() ? "" : "; there are " + spectral::joined(others))};
    }
    std::set<double> own;
    for (const Block& block : blocks)
        own.insert(header.tristimulus ? static_cast<double>(block.channel) : block.nanometres / 1000);
    const std::vector<double> channels{own.begin(), own.end()};
    if (header.tristimulus && channels.size() != 3) throw Error{name + ": must have TrisX, TrisY and TrisZ"};
    if (wavelengths && wavelengths->size() != channels.size()) {
        throw Error{name + ": holds " + std::to_string(channels.size()) + " channels, not " +
                    std::to_string(wavelengths->size())};
    }
    ScatterPoints points{
        wavelengths ? *wavelengths
        : header.tristimulus
            ? rgb_wavelengths()
            : spectral::located(name, [&] { return WavelengthGrid::from_micrometres(channels); }),
        {},
        {}};
    if (header.tristimulus && !wavelengths) points.channels = xyz_channels();
    // the blocks of each direction of light, by channel
    std::map<std::pair<double, double>, std::vector<const Block*>> lights;
    for (const Block& block : blocks) {
        auto& of_light = lights[{block.theta_i, block.phi_i}];
        of_light.resize(channels.size());
        const double channel =
            header.tristimulus ? static_cast<double>(block.channel) : block.nanometres / 1000;
        of_light[static_cast<std::size_t>(std::ranges::lower_bound(channels, channel) - channels.begin())] =
            &block;
    }
    for (const auto& [light, of_light] : lights) {
        const auto missing = std::count(of_light.begin(), of_light.end(), nullptr);
        if (missing > 0) {
            throw Error{name + ": AOI " + shortest(light.first) + ", POI " + shortest(light.second) + ": " +
                        std::to_string(of_light.size() - static_cast<std::size_t>(missing)) + " of " +
                        std::to_string(of_light.size()) + " channels: must have all"};
        }
        for (std::size_t node = 0; node < header.azimuth.size() * header.polar.size(); ++node) {
            const double polar = header.polar[node % header.polar.size()];
            if (polar > 90) continue;
            const double turn = header.azimuth[node / header.polar.size()] - azimuth_of_light;
            const bool in_plane = std::abs(std::remainder(turn, 180)) < 1e-4;
            for (const double side : {1.0, -1.0}) {
                if (side < 0 && (!header.symmetric || in_plane || polar == 0)) continue;
                points.angles.push_back({light.first, light.second, polar, light.second + side * turn});
                for (const Block* block : of_light) points.values.push_back(block->values[node]);
            }
        }
    }
    points.notes.push_back("read: " + std::to_string(blocks.size()) + " blocks of BRDF Front" +
                           (others.empty() ? "" : "; left out: " + spectral::joined(others)));
    if (tokens.negative().count > 0) points.notes.push_back(tokens.negative().text());
    return points;
}

std::string lighttools_text(const spectral::Reflectance& brdf, AngularGrid grid) {
    grid.check();
    if (!brdf.properties().isotropic)
        throw Error{brdf.name() +
                    ": depends on the azimuth of the light: must be isotropic in a LightTools file"};
    const bool symmetric = is_plane_symmetric(brdf);
    if (!symmetric) grid = without_symmetry(std::move(grid));
    const auto um = brdf.wavelengths().micrometres();
    const std::vector<double> values = values_on(grid, brdf);
    std::string text = "# BRDF in 1/sr without the cosine, angles in degrees, written by hts\n";
    text += symmetric ? "Symmetry PlaneSymmetrical\n" : "Symmetry Asymmetric\n";
    text += "SpectralContent Monochrome\n";
    const auto append_list = [&](const char* key, const std::vector<double>& list, double off) {
        text.append(key).append(" ").append(std::to_string(list.size())).append("\n");
        for (std::size_t i = 0; i < list.size(); ++i) {
            append_rounded(text, list[i] + off, 9);
            text += i + 1 < list.size() ? ' ' : '\n';
        }
    };
    append_list("ScatterAzimuth", grid.azimuth, azimuth_of_light);
    append_list("ScatterRadial", grid.polar, 0);
    text += "DataBegin\n";
    for (std::size_t i = 0; i < grid.theta_i.size(); ++i) {
        const Direction in = Direction::from_degrees(grid.theta_i[i], 0);
        for (std::size_t w = 0; w < um.size(); ++w) {
            text += "AOI ";
            append_rounded(text, grid.theta_i[i], 9);
            text += " POI 0 Side Front Wavelength ";
            append_rounded(text, 1000 * um[w], 9);
            const auto albedo = brdf.albedo(in, w);
            text += " ScatterType BRDF TIS ";
            append_rounded(text, albedo.total() - albedo.specular);
            text += '\n';
            for (std::size_t a = 0; a < grid.azimuth.size(); ++a)
                for (std::size_t r = 0; r < grid.polar.size(); ++r) {
                    const std::size_t node = (i * grid.azimuth.size() + a) * grid.polar.size() + r;
                    append_rounded(text, values[node * um.size() + w]);
                    text += r + 1 < grid.polar.size() ? ' ' : '\n';
                }
        }
    }
    return text + "DataEnd\n";
}

}  // namespace hts::tables
