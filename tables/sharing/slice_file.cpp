#include "tables/sharing/slice_file.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/json_value.hpp"
#include "tables/formats/little_endian.hpp"
#include "tables/formats/whole_file.hpp"
#include "tables/table/crc64.hpp"
#include "tables/table/table_contents.hpp"

namespace hts::tables {
namespace {

using nlohmann::ordered_json;
using spectral::JsonValue;

constexpr std::string_view magic = "HTSTPART";
constexpr std::uint32_t format_version = 1;
constexpr std::size_t prelude_bytes = 32, record_head = 16;

std::string header_text(const PartHeader& header) {
    const auto& [job, plan, shard] = header;
    ordered_json text;
    text["name"] = job.source.name;
    text["library_version"] = library_version();
    text["material_path"] = job.source.material_path;
    text["material"] = job.source.material;
    text["clamp"] = job.source.policy == spectral::OutsideRange::hold;
    text["wavelengths_um"] = job.wavelengths_um;
    text["tolerance"] = job.request.tolerance;
    text["seed"] = job.request.seed;
    text["polarised"] = job.request.polarised;
    text["largest_bytes"] = job.request.largest_bytes;
    text["spacing"] = {plan.spacing.grazing, plan.spacing.turn};
    text["nodes"] = {plan.nodes.grazing, plan.nodes.ratio, plan.nodes.turn};
    text["floor"] = plan.floor;
    text["basis"] = plan.basis;
    text["refinements"] = plan.refinements;
    text["shard"] = {shard.number, shard.count};
    return text.dump(1);
}

std::vector<double> numbers_in(const JsonValue& list) {
    std::vector<double> numbers;
    for (const JsonValue& item : list.items()) numbers.push_back(item.number());
    return numbers;
}

std::size_t whole(const JsonValue& key) {
    const double value = key.number();
    if (value >= 0 && value <= 0x1p53 && value == std::floor(value)) return static_cast<std::size_t>(value);
    throw key.error(shortest(value) + ": must be a whole number from 0 to 2^53");
}

std::vector<std::size_t> whole_numbers(const JsonValue& list, std::size_t count, std::size_t least,
                                       std::size_t most) {
    std::vector<std::size_t> numbers;
    for (const JsonValue& item : list.items()) numbers.push_back(whole(item));
    for (const std::size_t number : numbers) {
        if (number < least || number > most) {
            throw list.error(std::to_string(number) + ": must be from " + std::to_string(least) + " to " +
                             std::to_string(most));
        }
    }
    if (numbers.size() != count) throw list.error("must be " + std::to_string(count) + " numbers");
    return numbers;
}

PartHeader header_from(const std::string& text, const std::string& name) {
    const JsonValue head = JsonValue::parse(text, name);
    const JsonValue version = head["library_version"];
    if (version.text() != library_version()) {
        throw version.error("\"" + version.text() + "\": must be " + library_version() +
                            ", the version that builds the rest");
    }
    PartHeader header;
    header.job = {{head["name"].text(), head["material"].text(), head["material_path"].text(),
                   head["clamp"].boolean() ? spectral::OutsideRange::hold : spectral::OutsideRange::error},
                  numbers_in(head["wavelengths_um"]),
                  {head["tolerance"].number(), whole(head["seed"]), head["polarised"].boolean(),
                   whole(head["largest_bytes"])}};
    header.plan.request = header.job.request;
    const auto spacing = numbers_in(head["spacing"]);
    if (spacing.size() != 2) throw head["spacing"].error("must be two numbers");
    header.plan.spacing = {spacing[0], spacing[1]};
    constexpr std::size_t most_nodes = 65536;
    const auto nodes = whole_numbers(head["nodes"], 3, 5, most_nodes);
    header.plan.nodes.grazing = nodes[0];
    header.plan.nodes.ratio = nodes[1];
    header.plan.nodes.turn = nodes[2];
    header.plan.floor = numbers_in(head["floor"]);
    header.plan.basis = numbers_in(head["basis"]);
    header.plan.refinements = whole(head["refinements"]);
    if (header.plan.floor.size() != header.job.wavelengths_um.size() || header.plan.floor.empty() ||
        header.plan.basis.empty() || header.plan.basis.size() % header.plan.floor.size() != 0) {
        throw head["basis"].error("must be spectra over the wavelengths");
    }
    const auto shard = whole_numbers(head["shard"], 2, 1, most_nodes);
    header.shard = {shard[0], shard[1]};
    return header;
}

std::uint64_t record_checksum(std::string_view number, std::string_view values) {
    return crc64(values, crc64(number));
}

}  // namespace

std::string part_header_bytes(const PartHeader& header) {
    const std::string text = header_text(header);
    std::string bytes{magic};
    append_little_endian(bytes, format_version);
    append_little_endian(bytes, byte_order);
    append_little_endian(bytes, static_cast<std::uint64_t>(text.size()));
    append_little_endian(bytes, crc64(text));
    return bytes + text;
}

std::string slice_bytes(std::size_t slice, const std::vector<double>& values) {
    std::string number, numbers, bytes;
    append_little_endian(number, static_cast<std::uint64_t>(slice));
    append_numbers<double>(numbers, values);
    bytes = number;
    append_little_endian(bytes, record_checksum(number, numbers));
    return bytes + numbers;
}

PartHeader header_from_bytes(std::string_view bytes, const std::string& name) {
    if (bytes.size() < prelude_bytes || bytes.substr(0, magic.size()) != magic ||
        from_little_endian<std::uint32_t>(bytes.substr(8)) != format_version ||
        from_little_endian<std::uint32_t>(bytes.substr(12)) != byte_order) {
        throw Error{name + ": is no part of a table: must be a file that hts table build --shard wrote"};
    }
    const auto size = from_little_endian<std::uint64_t>(bytes.substr(16));
    if (size > bytes.size() - prelude_bytes ||
        crc64(bytes.substr(prelude_bytes, size)) != from_little_endian<std::uint64_t>(bytes.substr(24))) {
        throw Error{name + ": its header is cut short or changed: must be the file as it was written"};
    }
    return header_from(std::string{bytes.substr(prelude_bytes, size)}, name);
}

bool is_header_cut_short(const std::filesystem::path& path) {
    const std::string bytes = read_whole_file(path);
    if (bytes.size() < prelude_bytes) return magic.substr(0, bytes.size()) == bytes.substr(0, magic.size());
    return bytes.starts_with(magic) && from_little_endian<std::uint64_t>(std::string_view{bytes}.substr(16)) >
                                           bytes.size() - prelude_bytes;
}

Part read_part(const std::filesystem::path& path) {
    const std::string bytes = read_whole_file(path);
    PartHeader header = header_from_bytes(bytes, path.string());
    Part part{std::move(header),
              {},
              prelude_bytes + from_little_endian<std::uint64_t>(std::string_view{bytes}.substr(16))};
    const TablePlan& plan = part.header.plan;
    const std::size_t components = plan.basis.size() / plan.floor.size();
    const double record = static_cast<double>(plan.nodes.ratio) * static_cast<double>(plan.nodes.turn) *
                          static_cast<double>(components) * sizeof(double);
    const std::string_view all{bytes};
    while (static_cast<double>(bytes.size() - part.sound_bytes) >= record + record_head) {
        const auto record_bytes = static_cast<std::size_t>(record);
        const std::size_t at = part.sound_bytes;
        const auto slice = from_little_endian<std::uint64_t>(all.substr(at));
        const std::string_view numbers = all.substr(at + record_head, record_bytes);
        const bool sound = slice < plan.slices() && from_little_endian<std::uint64_t>(all.substr(at + 8)) ==
                                                        record_checksum(all.substr(at, 8), numbers);
        if (!sound) break;
        std::vector<double>& values = part.slices[slice];
        values.resize(record_bytes / sizeof(double));
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = from_little_endian<double>(numbers.substr(i * sizeof(double)));
        }
        part.sound_bytes += record_head + record_bytes;
    }
    return part;
}

}  // namespace hts::tables
