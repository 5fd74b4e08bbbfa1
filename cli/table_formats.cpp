#include "cli/table_formats.hpp"

namespace hts::cli {

const std::vector<TableFormat>& table_formats() {
    static const std::vector<TableFormat> formats{};
    return formats;
}

}  // namespace hts::cli
