// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/programme.h>
#include <slipstep/experiment/programme_text.h>
#include <slipstep/utilities/paths.h>
#include <slipstep/utilities/text.h>

#include <algorithm>

namespace SlipStep
{
  Piece trim(const Piece &piece)
  {
    const auto begin = piece.text.find_first_not_of(blanks);
    if (begin == std::string::npos)
      return {"", piece.column};
    const auto end = piece.text.find_last_not_of(blanks);
    return {piece.text.substr(begin, end - begin + 1), piece.column + begin};
  }



  std::vector<Piece> words(const Piece &piece)
  {
    std::vector<Piece> result;
    std::size_t        begin = piece.text.find_first_not_of(blanks);
    while (begin != std::string::npos)
      {
        const auto end =
          std::min(piece.text.find_first_of(blanks, begin), piece.text.size());
        result.push_back(
          {piece.text.substr(begin, end - begin), piece.column + begin});
        begin = piece.text.find_first_not_of(blanks, end);
      }
    return result;
  }



  std::string relocated_programme(const std::string           &text,
                                  const std::filesystem::path &from,
                                  const std::filesystem::path &to)
  {
    const std::string verb = "follow";
    std::string       result;
    for (std::size_t begin = 0; begin < text.size();)
      {
        const auto end =
          std::min(text.find_first_of(borders, begin), text.size());
        const Piece piece = trim({text.substr(begin, end - begin), begin});
        const std::string name =
          is_same_word(piece.text.substr(0, verb.size()), verb) ?
            trim({piece.text.substr(verb.size()), 0}).text :
            "";
        if (name.empty())
          result += text.substr(begin, end - begin);
        else
          result += text.substr(begin, piece.column - begin) + verb + " " +
                    path_from(to, from / with_home(name));
        if (end < text.size())
          result += text[end];
        begin = end + 1;
      }
    return result;
  }
} // namespace SlipStep
