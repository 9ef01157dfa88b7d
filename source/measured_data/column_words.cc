// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/measured_data/column_words.h>
#include <slipstep/measured_data/import_columns.h>
#include <slipstep/measured_data/measured_test.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <cctype>
#include <map>

namespace SlipStep
{
  const std::vector<KeyWords> &key_words()
  {
    // Words stand between blanks; also in Japanese and Chinese, in UTF-8.
    static const std::vector<KeyWords> all = {
      {"Time",
       "time zeit elapsed temps 時間 时间",
       "t",
       "step date tempera temp_ temp."},
      {"Displacement",
       "disp position distance weg stroke travel slip verschiebung strecke "
       "crosshead traverse extension encoder depl d\xC3\xA9pl d\xE9pl "
       "変位 位移 滑り",
       "x y u s d pos path hub course",
       "wear verschlei radius thick dicke width height norm nor_ vertical "
       "penetr eindring depth tiefe gap spalt"},
      // Not "geschWINDigkeit" or "umFANgs...".
      {"Speed",
       "speed veloc geschw vitesse 速度",
       "v",
       "set soll target wind_ winds windg fan_ fans"},
      {"Friction",
       "coefficient fric reibwert reibungszahl beiwert reibungskoeff "
       "摩擦係数 摩擦系数",
       "mu cof \xC2\xB5 \xCE\xBC \xB5 f",
       "force kraft load stress torque moment"},
      {"Tangential load",
       "fric tangenti reibkraft reibungskraft shear lateral pull zugkraft "
       "frottement 摩擦力 切向力",
       "ft fx fy f_t f_x f_y ff fr f_r t f force kraft",
       "coefficient stress norm torque"},
      {"Normal load",
       "norm nor_ load anpress last vertical clamp clamp_force clamping "
       "荷重 载荷 法向力 正压力",
       "fn fz f_n f_z n p charge",
       "stress fric frottement tangenti shear shr_"},
      {"Pressure",
       "pressure stress druck pressung pression spannung norm nor_ 圧力",
       "p sigma sigma_n sn",
       "shear shr_ tau schub oil fric atmos disp force load last"},
      {"Temperature", "temp 温度", "t theta", "temps"}};
    return all;
  }



  KeyWords::KeyWords(const std::string &key,
                     const std::string &words,
                     const std::string &labels,
                     const std::string &against)
    : key(key)
    , words(dealii::Utilities::split_string_list(words, ' '))
    , labels(dealii::Utilities::split_string_list(labels, ' '))
    , against(dealii::Utilities::split_string_list(against, ' '))
    , is_along_axis(key == "Displacement" || key == "Friction" ||
                    key == "Tangential load")
  {}



  bool has_word(const std::string &name, const std::vector<std::string> &words)
  {
    return any_of(words, [&](const auto &word) {
      return name.find(word) != std::string::npos;
    });
  }



  const std::vector<std::string> &shear_words()
  {
    static const auto words =
      dealii::Utilities::split_string_list("shear shr_ tau schub", ' ');
    return words;
  }



  const std::vector<std::string> &ordered_words()
  {
    static const std::vector<std::string> words = {
      " set", "_set", "soll", "target", "nominal", "_cmd", "command"};
    return words;
  }



  bool is_called_normal(const std::string &name)
  {
    using dealii::Utilities::split_string_list;
    static const auto words = split_string_list("norm nor_ anpress clamp", ' ');
    static const auto labels =
      split_string_list("fn fz f_n f_z n p sigma_n sn", ' ');
    return has_word(name, words) || holds(labels, label_of(name));
  }



  // "fz act" is "fz".
  std::string label_of(const std::string &name)
  {
    static const auto qualifiers = dealii::Utilities::split_string_list(
      "set soll target nominal cmd act actual ist meas measured gemessen avg mean",
      ' ');
    static const std::vector<std::string> forces = {"force ",
                                                    "force_",
                                                    "kraft ",
                                                    "kraft_"};

    const std::size_t at = name.find_last_of(" _.");
    if (at == std::string::npos || at == 0)
      return name;
    const std::string last = name.substr(at + 1);
    if (last.empty() || holds(qualifiers, last))
      return label_of(name.substr(0, at));
    return holds(forces, name.substr(0, at + 1)) && axis_of(last) != '\0' ?
             "f" + last :
             name;
  }



  char axis_of(const std::string &name)
  {
    std::string word;
    for (const char c : name + ' ')
      if (std::isalnum(static_cast<unsigned char>(c)) != 0)
        word += c;
      else
        {
          if (word.size() == 2 && word[0] == 'f')
            word.erase(0, 1);
          if (word == "x" || word == "y" || word == "z")
            return word[0];
          word.clear();
        }
    return '\0';
  }



  std::string unit_of_weight(const std::string &unit)
  {
    static const std::map<std::string, std::string> weights = {
      {"kg", "kgf"}, {"g", "gf"}, {"t", "tf"}, {"lb", "lbf"}, {"lbs", "lbf"}};
    const auto found = weights.find(lower_case(unit));
    return found == weights.end() ? "" : found->second;
  }



  // "Displ [mm]", "displacement_mm", "Time, s", "Weg in mm", "F / N".
  void
  split_name(const std::string &heading, std::string &name, std::string &unit)
  {
    const Heading split = split_heading(heading);
    name                = split.name;
    unit                = split.unit;
    if (split.has_brackets)
      return;
    for (const std::string mark : {" in ", ", ", " / ", "/", "_", " "})
      {
        const std::size_t at = heading.rfind(mark);
        if (at == std::string::npos || at == 0)
          continue;
        const std::string behind = heading.substr(at + mark.size());
        // "Encoder in" is an input.
        if (!dimension_of_unit(behind).has_value() ||
            (lower_case(behind) == "in" && mark != " in "))
          continue;
        name = split_heading(heading.substr(0, at)).name;
        unit = behind;
        return;
      }
  }
} // namespace SlipStep
