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

std::string escaped(std::string_view text) {
    std::string result;
    for (const char character : text) {
        switch (character) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            default:
                result += character;
        }
    }
    return result;
}

std::string document(const std::string& name, std::string_view structure, std::string_view bases,
                     const std::string& data) {
    std::string text = R"(<?xml version="1.0" encoding="UTF-8"?>
<WindowElement xmlns="http://windows.lbl.gov">
<WindowElementType>System</WindowElementType>
<FileType>BSDF</FileType>
<Optical>
<Layer>
<Material>
<Name>)";
    text.append(escaped(name)).append(R"(</Name>
<Manufacturer>hts</Manufacturer>
<DeviceType>Other</DeviceType>
</Material>
<DataDefinition>
<IncidentDataStructure>)");
    text.append(structure).append(R"(</IncidentDataStructure>
</DataDefinition>
<WavelengthData>
<LayerNumber>System</LayerNumber>
<Wavelength unit="Integral">Visible</Wavelength>
<SourceSpectrum>CIE Illuminant D65 1nm.ssp</SourceSpectrum>
<DetectorSpectrum>ASTM E308 1931 Y.dsp</DetectorSpectrum>
<WavelengthDataBlock>
<WavelengthDataDirection>Reflection Back</WavelengthDataDirection>
)");
    text.append(bases).append(R"(<ScatteringDataType>BRDF</ScatteringDataType>
<ScatteringData>
)");
    text.append(data).append(R"(
</ScatteringData>
</WavelengthDataBlock>
</WavelengthData>
</Layer>
</Optical>
</WindowElement>
)");
    return text;
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
                              std::string{direction}.append(", ").append(spectrum)});
        }
    }
    return blocks;
}

// The block to read: visible, on the side of the normal before the other. Notes tell which it was.
pugi::xml_node reflection_block(const Document& document, const pugi::xml_node& layer,
                                std::vector<std::string>& notes) {
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
    for (const Block& block : blocks)
        if (&block != best) others.push_back("\"" + block.name + "\"");
    if (best == nullptr) {
        throw document.error(layer,
                             "no block of Reflection Back or Reflection Front for the wavelength Visible" +
                                 (others.empty() ? "" : "; there are " + spectral::joined(others)));
    }
    notes.push_back("read: \"" + best->name + "\"" +
                    (best->side == 2 ? ", the side of the normal"
                                     : ", the other side, since there is no Reflection Back") +
                    (others.empty() ? "" : "; left out: " + spectral::joined(others)));
    return best->node;
}

spectral::Reflectance matrix(const Document& document, const pugi::xml_node& block, Tokens& tokens,
                             bool light_fastest, const spectral::WavelengthGrid& wavelength) {
    const auto columns = document.text(block, "ColumnAngleBasis"),
               rows = document.text(block, "RowAngleBasis");
    if (!same_letters(columns, rows))
        throw document.error(block, "ColumnAngleBasis and RowAngleBasis: must be the same");
    const KlemsBasis* basis = nullptr;
    try {
        basis = &KlemsBasis::named(columns);
    } catch (const Error& failure) {
        throw document.error(block, failure.what());
    }
    const std::size_t size = basis->size();
    std::vector<double> numbers;
    while (numbers.size() < size * size) numbers.push_back(tokens.take_value("BRDF"));
    if (!tokens.at_end())
        throw tokens.error("more than " + std::to_string(size) + " times " + std::to_string(size) +
                           " numbers");
    std::vector<double> means(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
        means[light_fastest ? i : i % size * size + i / size] = numbers[i];
    return klems_brdf(document.name(), wavelength, *basis, std::move(means));
}

spectral::Reflectance tree(const Document& document, Tokens& tokens, int rank,
                           const spectral::WavelengthGrid& wavelength) {
    auto brdf = tensor_tree_brdf(document.name(), wavelength, rank, tokens);
    if (!tokens.at_end()) throw tokens.error("text after the tree");
    return brdf;
}

}  // namespace

std::string klems_xml(const spectral::Reflectance& brdf, const KlemsBasis& basis, bool specular) {
    const std::vector<double> means = klems_means(brdf, basis, specular);
    std::string data;
    for (std::size_t i = 0; i < means.size(); ++i) {
        append_rounded(data, means[i]);
        data += (i + 1) % basis.size() == 0 ? '\n' : ' ';
    }
    std::string bases = "<ColumnAngleBasis>";
    bases.append(basis.name()).append("</ColumnAngleBasis>\n<RowAngleBasis>").append(basis.name());
    bases += "</RowAngleBasis>\n";
    return document(brdf.name(), "Columns", bases, data);
}

std::string tensor_tree_xml(const spectral::Reflectance& brdf, const TensorTreeOptions& options) {
    const std::string_view structure = brdf.properties().isotropic ? "TensorTree3" : "TensorTree4";
    return document(brdf.name(), structure, "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>\n",
                    tensor_tree_text(brdf, options));
}

RadianceFile radiance_file(std::string_view text, const std::string& name,
                           const std::optional<spectral::WavelengthGrid>& wavelength) {
    const Document file{text, name};
    const auto layer = file.layer();
    const auto definition = layer.child("DataDefinition");
    if (!definition) throw file.error(layer, "element DataDefinition: missing");
    const auto structure = file.text(definition, "IncidentDataStructure");
    std::vector<std::string> notes;
    const auto block = reflection_block(file, layer, notes);
    const auto type = trimmed(block.child_value("ScatteringDataType"));
    if (!type.empty() && !same_letters(type, "BRDF") && !same_letters(type, "BSDF")) {
        throw file.error(
            block, "ScatteringDataType " + spectral::in_quotes(type.substr(0, 40)) + ": must be BRDF [1/sr]");
    }
    const auto scattering = block.child("ScatteringData");
    if (!scattering) throw file.error(block, "element ScatteringData: missing");
    Tokens tokens{scattering.child_value(), name, file.line(scattering)};
    const auto& channel = wavelength ? *wavelength : luminance_wavelength();
    if (channel.size() != 1) throw Error{name + ": holds 1 channel, not " + std::to_string(channel.size())};
    const auto read = [&] {
        if (same_letters(structure, "TensorTree3")) return tree(file, tokens, 3, channel);
        if (same_letters(structure, "TensorTree4")) return tree(file, tokens, 4, channel);
        if (same_letters(structure, "Columns")) return matrix(file, block, tokens, true, channel);
        if (same_letters(structure, "Rows")) return matrix(file, block, tokens, false, channel);
        throw file.error(definition, "IncidentDataStructure " + spectral::in_quotes(structure.substr(0, 40)) +
                                         ": must be Columns, Rows, TensorTree3 or TensorTree4");
    };
    RadianceFile result{read(), std::move(notes)};
    if (tokens.negative().count > 0) result.notes.push_back(tokens.negative().text());
    return result;
}

spectral::Reflectance radiance_brdf(std::string_view text, const std::string& name,
                                    const std::optional<spectral::WavelengthGrid>& wavelength) {
    return radiance_file(text, name, wavelength).brdf;
}

}  // namespace hts::tables
