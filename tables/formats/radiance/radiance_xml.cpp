#include "tables/formats/radiance/radiance_xml.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <pugixml.hpp>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/points/tokens.hpp"

namespace hts::tables {
namespace {

using spectral::same_letters;
using spectral::trimmed;

// Where the document begins: some writers put a line of their log in front.
std::size_t beginning(std::string_view text) {
    const auto at = std::min(text.find("<?xml"), text.find("<WindowElement"));
    return at == std::string_view::npos ? 0 : at;
}

// A document with the lines of its parts.
class Document {
  public:
    Document(std::string_view text, std::string name)
        : text_{text}, beginning_{beginning(text)}, name_{std::move(name)} {
        const auto result = xml_.load_buffer(text.data() + beginning_, text.size() - beginning_);
        if (!result)
            throw Error{name_ + ":" + std::to_string(line(result.offset)) +
                        ": not valid XML: " + result.description()};
    }

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] pugi::xml_node layer() const {
        const auto layer = xml_.child("WindowElement").child("Optical").child("Layer");
        if (!layer) throw Error{name_ + ": element WindowElement/Optical/Layer: missing"};
        return layer;
    }
    [[nodiscard]] std::size_t line(const pugi::xml_node& node) const { return line(node.offset_debug()); }
    [[nodiscard]] Error error(const pugi::xml_node& node, const std::string& message) const {
        return Error{name_ + ":" + std::to_string(line(node)) + ": " + message};
    }
    /// Text of a child that must be there.
    [[nodiscard]] std::string_view text(const pugi::xml_node& node, const char* child) const {
        const auto found = node.child(child);
        if (!found) throw error(node, std::string{"element "}.append(child).append(": missing"));
        return trimmed(found.child_value());
    }

  private:
    [[nodiscard]] std::size_t line(std::ptrdiff_t offset) const {
        const auto end = std::clamp<std::ptrdiff_t>(offset + static_cast<std::ptrdiff_t>(beginning_), 0,
                                                    static_cast<std::ptrdiff_t>(text_.size()));
        return 1 + static_cast<std::size_t>(std::count(text_.begin(), text_.begin() + end, '\n'));
    }

    std::string_view text_;
    std::size_t beginning_;
    std::string name_;
    pugi::xml_document xml_;
};

// A block and how it is called, "Reflection Back, Visible".
struct Block {
    pugi::xml_node node;
    bool visible;
    int side;  // 2 of the normal, 1 the other, 0 no reflection
    std::string name;
    std::string_view spectrum;
};

// What is read: luminance, and the two others of a file of colour.
struct Chosen {
    pugi::xml_node visible, before{}, after{};

    [[nodiscard]] bool coloured() const { return !before.empty() && !after.empty(); }
};

std::vector<Block> blocks_of(const pugi::xml_node& layer) {
    std::vector<Block> blocks;
    for (const auto& wavelength : layer.children("WavelengthData")) {
        const auto spectrum = trimmed(wavelength.child_value("Wavelength"));
        for (const auto& node : wavelength.children("WavelengthDataBlock")) {
            const auto direction = trimmed(node.child_value("WavelengthDataDirection"));
            const int side = same_letters(direction, "Reflection Back")    ? 2
                             : same_letters(direction, "Reflection Front") ? 1
                                                                           : 0;
            blocks.push_back({node, spectrum.empty() || same_letters(spectrum, "Visible"), side,
                              std::string{direction}.append(", ").append(spectrum), spectrum});
        }
    }
    return blocks;
}

// The block to read: visible, on the side of the normal before the other, with those of the two names if both
// are on that side. Notes tell which it was.
Chosen reflection_blocks(const Document& document, const pugi::xml_node& layer, const char* before,
                         const char* after, std::vector<std::string>& notes) {
    const auto blocks = blocks_of(layer);
    std::vector<std::string> others;
    const Block* best = nullptr;
    for (const Block& block : blocks) {
        if (!block.visible || block.side == 0) continue;
        if (best == nullptr || block.side > best->side) {
            best = &block;
        } else if (block.side == best->side) {
            throw document.error(block.node, "a second block of " + block.name + " (the first is on line " +
                                                 std::to_string(document.line(best->node)) +
                                                 "): must be one");
        }
    }
    Chosen chosen;
    std::string colour;
    if (best != nullptr) {
        const auto same_side = [&](const char* spectrum) {
            for (const Block& block : blocks)
                if (block.side == best->side && same_letters(block.spectrum, spectrum)) return block.node;
            return pugi::xml_node{};
        };
        chosen = {best->node, same_side(before), same_side(after)};
        if (chosen.coloured()) colour = std::string{", with "} + before + " and " + after;
    }
    for (const Block& block : blocks) {
        const bool of_colour =
            chosen.coloured() && (block.node == chosen.before || block.node == chosen.after);
        if (&block != best && !of_colour) others.push_back("\"" + block.name + "\"");
    }
    if (best == nullptr) {
        throw document.error(layer,
                             "no block of Reflection Back or Reflection Front for the wavelength Visible" +
                                 (others.empty() ? "" : "; there are " + spectral::joined(others)));
    }
    notes.push_back("read: \"" + best->name + "\"" + colour +
                    (best->side == 2 ? ", the side of the normal"
                                     : ", the other side, since there is no Reflection Back") +
                    (others.empty() ? "" : "; left out: " + spectral::joined(others)));
    return chosen;
}

// The numbers of a block, which must be a BRDF.
Tokens numbers_of(const Document& document, const pugi::xml_node& block) {
    const auto type = trimmed(block.child_value("ScatteringDataType"));
    if (!type.empty() && !same_letters(type, "BRDF") && !same_letters(type, "BSDF")) {
        throw document.error(
            block, "ScatteringDataType " + spectral::in_quotes(type.substr(0, 40)) + ": must be BRDF [1/sr]");
    }
    const auto scattering = block.child("ScatteringData");
    if (!scattering) throw document.error(block, "element ScatteringData: missing");
    return {scattering.child_value(), document.name(), document.line(scattering)};
}

double degrees_in(const Document& document, const pugi::xml_node& node, const char* child) {
    try {
        return spectral::number_in(document.text(node, child), child);
    } catch (const Error& failure) {
        throw document.error(node, failure.what());
    }
}

// As the file defines it, else one that is known by its name.
KlemsBasis basis_named(const Document& document, const pugi::xml_node& block, std::string_view name) {
    for (const auto& definition : document.layer().child("DataDefinition").children("AngleBasis")) {
        if (!same_letters(trimmed(definition.child_value("AngleBasisName")), name)) continue;
        std::vector<KlemsBasis::Ring> rings;
        for (const auto& ring : definition.children("AngleBasisBlock")) {
            const auto bounds = ring.child("ThetaBounds");
            const double patches = degrees_in(document, ring, "nPhis");
            if (!(patches >= 1 && patches <= 10'000 && patches == std::floor(patches)))
                throw document.error(
                    ring, "nPhis " + shortest(patches) + ": must be a whole number from 1 to 10000");
            const double low =
                rings.empty() && !bounds.child("LowerTheta") ? 0 : degrees_in(document, bounds, "LowerTheta");
            rings.push_back(
                {low, degrees_in(document, bounds, "UpperTheta"), static_cast<std::size_t>(patches)});
        }
        try {
            return {std::string{name}, std::move(rings)};
        } catch (const Error& failure) {
            throw document.error(definition, failure.what());
        }
    }
    try {
        return KlemsBasis::named(name);
    } catch (const Error& failure) {
        throw document.error(block, failure.what());
    }
}

void note_negative(const Tokens& tokens, std::vector<std::string>& notes) {
    if (tokens.negative().count > 0) notes.push_back(tokens.negative().text());
}

spectral::Reflectance matrix(const Document& document, const pugi::xml_node& block, bool light_fastest,
                             std::vector<std::string>& notes) {
    const auto columns = document.text(block, "ColumnAngleBasis"),
               rows = document.text(block, "RowAngleBasis");
    if (!same_letters(columns, rows))
        throw document.error(block, "ColumnAngleBasis and RowAngleBasis: must be the same");
    const KlemsBasis basis = basis_named(document, block, columns);
    const std::size_t size = basis.size();
    Tokens tokens = numbers_of(document, block);
    std::vector<double> numbers;
    while (numbers.size() < size * size) numbers.push_back(tokens.take_value("BRDF"));
    if (!tokens.at_end())
        throw tokens.error("more than " + std::to_string(size) + " times " + std::to_string(size) +
                           " numbers");
    note_negative(tokens, notes);
    std::vector<double> means(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
        means[light_fastest ? i : i % size * size + i / size] = numbers[i];
    return klems_brdf(document.name(), luminance_wavelength(), basis, std::move(means));
}

spectral::Reflectance tree(const Document& document, const pugi::xml_node& block, int rank,
                           std::vector<std::string>& notes) {
    Tokens tokens = numbers_of(document, block);
    auto brdf = tensor_tree_brdf(document.name(), luminance_wavelength(), rank, tokens);
    if (!tokens.at_end()) throw tokens.error("text after the tree");
    note_negative(tokens, notes);
    return brdf;
}

// Three channels of one value each as one BRDF.
spectral::Reflectance three(const std::string& name, const std::vector<spectral::Reflectance>& parts) {
    std::vector<spectral::Reflectance> renamed;
    for (std::size_t i = 0; i < 3; ++i) {
        const double um = rgb_wavelengths().micrometres()[i];
        renamed.push_back(with_channels_named(parts[i], spectral::WavelengthGrid::from_micrometres({um})));
    }
    return joined(name, std::move(renamed));
}

}  // namespace

RadianceFile radiance_file(std::string_view text, const std::string& name,
                           const std::optional<spectral::WavelengthGrid>& wavelength) {
    const Document file{text, name};
    const auto layer = file.layer();
    const auto definition = layer.child("DataDefinition");
    if (!definition) throw file.error(layer, "element DataDefinition: missing");
    const auto structure = file.text(definition, "IncidentDataStructure");
    const bool rank3 = same_letters(structure, "TensorTree3"), rank4 = same_letters(structure, "TensorTree4");
    const bool is_tree = rank3 || rank4, columns = same_letters(structure, "Columns");
    if (!is_tree && !columns && !same_letters(structure, "Rows"))
        throw file.error(definition, "IncidentDataStructure " + spectral::in_quotes(structure.substr(0, 40)) +
                                         ": must be Columns, Rows, TensorTree3 or TensorTree4");
    std::vector<std::string> notes;
    const Chosen chosen =
        reflection_blocks(file, layer, is_tree ? "CIE-u" : "CIE-Z", is_tree ? "CIE-v" : "CIE-X", notes);
    const auto read = [&](const pugi::xml_node& block) {
        return is_tree ? tree(file, block, rank3 ? 3 : 4, notes) : matrix(file, block, columns, notes);
    };
    const bool coloured = chosen.coloured() && !(wavelength && wavelength->size() == 1);
    const auto& names = wavelength ? *wavelength : coloured ? rgb_wavelengths() : luminance_wavelength();
    if (names.size() != (coloured ? 3U : 1U))
        throw Error{name + (coloured ? ": holds 3 channels, not " : ": holds 1 channel, not ") +
                    std::to_string(names.size())};
    if (!coloured) {
        auto luminance = with_channels_named(read(chosen.visible), names);
        return {std::move(luminance), std::move(notes), luminance_channel()};
    }
    auto all = three(name, {read(chosen.before), read(chosen.visible), read(chosen.after)});
    if (is_tree) all = tristimulus_of_chromaticity(std::move(all));
    return {with_channels_named(std::move(all), names), std::move(notes), xyz_channels()};
}

spectral::Reflectance radiance_brdf(std::string_view text, const std::string& name,
                                    const std::optional<spectral::WavelengthGrid>& wavelength) {
    return radiance_file(text, name, wavelength).brdf;
}

}  // namespace hts::tables
