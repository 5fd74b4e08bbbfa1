// hts table merge: joins the parts that shards of a build wrote.

#include <filesystem>
#include <memory>

#include "cli/io/options.hpp"
#include "cli/verbs/table/table.hpp"
#include "tables/sharing/table_parts.hpp"

namespace hts::cli {
namespace {

struct MergeOptions {
    std::vector<std::string> parts;
    std::string output;
};

}  // namespace

void add_table_merge(CLI::App& table) {
    CLI::App* verb = table.add_subcommand("merge", "join the parts that hts table build --shard wrote");
    auto options = std::make_shared<MergeOptions>();
    reads(verb->add_option("parts", options->parts, "files of all shards, in any order"))->required();
    writes(verb->add_option("--output,-o", options->output, "table to write"))->required();
    verb->footer(R"(
Examples:
  hts table build --material cli/data/rough-aluminium.json --wavelengths 0.5 --tolerance 0.02 \
      --shard 1/2 --output part.1
  hts table build --material cli/data/rough-aluminium.json --wavelengths 0.5 --tolerance 0.02 \
      --shard 2/2 --output part.2
  hts table merge part.1 part.2 --output m.htst)");
    verb->callback([options] {
        tables::merge_table_file({options->parts.begin(), options->parts.end()}, options->output);
    });
}

}  // namespace hts::cli
