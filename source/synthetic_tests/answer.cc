// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/synthetic_tests/answer.h>

#include <slipstep/utilities/exceptions.h>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <boost/crc.hpp>

#include <nlohmann/json.hpp>

#include <fstream>
#include <iomanip>
#include <sstream>

namespace SlipStep
{
  namespace Planting
  {
    using json = nlohmann::ordered_json;

    namespace
    {
      const std::string seal = "# sealed answer of slipstep plant, checksum ";

      std::string checksum(const std::string &text)
      {
        boost::crc_32_type crc;
        crc.process_bytes(text.data(), text.size());
        std::ostringstream out;
        out << std::hex << std::setw(8) << std::setfill('0') << crc.checksum();
        return out.str();
      }

      json to_json(const std::vector<TruthParameter> &parameters)
      {
        json list = json::array();
        for (const TruthParameter &parameter : parameters)
          list.push_back({{"name", parameter.name},
                          {"value", parameter.value},
                          {"unit", parameter.unit}});
        return list;
      }
    } // namespace



    std::string answer_json(const PlantedCampaign &campaign)
    {
      const CampaignOptions &options = campaign.options;
      json                   hidden = json::array(), tests = json::array();
      for (const PlantedEffect &effect : campaign.hidden)
        hidden.push_back({{"effect", effect.name},
                          {"formula_kind", to_string(effect.formula)},
                          {"formula", effect.formula_text},
                          {"amplitude", effect.amplitude},
                          {"parameters", to_json(effect.parameters)}});
      for (const PlantedTest &test : campaign.tests)
        tests.push_back({{"file", test.measured.file.string()},
                         {"condition", test.measured.condition},
                         {"gain", test.noise.gain},
                         {"offset_x", test.noise.offset_x},
                         {"offset_y", test.noise.offset_y}});
      const NoiseLevels &noise  = campaign.noise;
      const json         answer = {
                {"schema", "slipstep planted campaign 1"},
                {"class", to_string(options.campaign_class)},
                {"seed", options.seed},
                {"edition", options.edition},
                {"hidden", hidden},
                {"effects_of_truth", campaign.base_effects},
                {"base_parameters", to_json(campaign.base_parameters)},
                {"noise",
                 {{"kind", to_string(noise.kind)},
                  {"white", noise.white},
                  {"position", noise.position},
                  {"pressure", noise.pressure},
                  {"drift", noise.drift},
                  {"drift_correlation_times", noise.correlation_times},
                  {"gain", noise.gain},
                  {"offset", noise.offset}}},
                {"tests", tests}};
      return answer.dump(2) + '\n';
    }



    std::string sealed(const std::string &text)
    {
      using namespace boost::archive::iterators;
      using Encoded =
        base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
      constexpr std::size_t width = 76;

      // Blanks at the end fill up to whole groups of three.
      const std::string full =
        text + std::string((3 - text.size() % 3) % 3, ' ');
      const std::string code(Encoded(full.begin()), Encoded(full.end()));
      std::string       result = seal + checksum(text) +
                           "; to read it: slipstep plant --open <this file>\n";
      for (std::size_t at = 0; at < code.size(); at += width)
        result += code.substr(at, width) + '\n';
      return result;
    }



    std::string open_sealed(const std::filesystem::path &file)
    {
      using namespace boost::archive::iterators;
      using Decoded =
        transform_width<binary_from_base64<std::string::const_iterator>, 8, 6>;

      std::ifstream in(file);
      std::string   line, code;
      if (!in)
        throw InputError(file.string() + ": this file cannot be opened");
      if (!std::getline(in, line) || line.compare(0, seal.size(), seal) != 0)
        throw InputError(file.string() +
                         ": is not a sealed answer of slipstep plant");
      const std::string expected = line.substr(seal.size(), 8);
      // Mail may have changed the ends of lines.
      while (std::getline(in, line))
        code += dealii::Utilities::trim(line);
      try
        {
          if (code.size() % 4 != 0)
            throw dataflow_exception();
          std::string text(Decoded(code.cbegin()), Decoded(code.cend()));
          text.erase(text.find_last_not_of(' ') + 1);
          if (checksum(text) != expected)
            throw dataflow_exception();
          return text;
        }
      catch (const dataflow_exception &)
        {
          throw InputError(file.string() +
                           ": this sealed answer was changed or "
                           "damaged after it was written");
        }
    }
  } // namespace Planting
} // namespace SlipStep
