// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/json_file.h>
#include <slipstep/utilities/write_file.h>

namespace SlipStep
{
  // Names may hold anything: what is no UTF-8 is replaced.
  void write_json(const std::filesystem::path  &file,
                  const nlohmann::ordered_json &object)
  {
    write_file(file,
               object.dump(2,
                           ' ',
                           false,
                           nlohmann::ordered_json::error_handler_t::replace) +
                 "\n");
  }
} // namespace SlipStep
