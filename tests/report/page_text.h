// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_tests_report_page_text_h
#define slipstep_tests_report_page_text_h

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/file_text.h"
#include "tests/temporary_folder.h"

inline void has_all(const std::string              &text,
                    const std::vector<std::string> &parts)
{
  for (const std::string &part : parts)
    EXPECT_TRUE(contains(text, part));
}



inline void has_none(const std::string              &text,
                     const std::vector<std::string> &parts)
{
  for (const std::string &part : parts)
    EXPECT_FALSE(contains(text, part));
}



/// Every tag that is opened is closed, in order. (Tags without content are
/// closed in SVG and are a known few in HTML.)
inline std::string unbalanced_tag(const std::string &page)
{
  const std::vector<std::string> empty = {"meta", "br", "wbr", "!DOCTYPE"};
  std::vector<std::string>       open;
  for (std::size_t at = page.find('<'); at != std::string::npos;
       at             = page.find('<', at + 1))
    {
                  if (page.compare(at, 4, "<!--") == 0 ||
          page.compare(at, 9, "<![CDATA[") == 0)
        continue;
      const std::size_t end    = page.find('>', at);
                  const bool        closes = page[at + 1] == '/';
                  const std::size_t begin  = at + (closes ? 2 : 1);
                  const std::string name =
                    page.substr(begin, page.find_first_of(" \t\n/>", begin) - begin);
                  if (closes)
        {
                      if (open.empty() || open.back() != name)
            return "</" + name + ">";
          open.pop_back();
        }
      // What is in it are no tags.
                  else if (name == "script")
        at = page.find("</script>", at);
      else if (page[end - 1] != '/' &&
               std::find(empty.begin(), empty.end(), name) == empty.end())
        open.push_back(name);
    }
  return open.empty() ? "" : "<" + open.back() + ">";
}



/// The page in the folder of the test: it is well-formed, and neither it nor
/// the scripts of its pictures have a number that is none.
inline std::string sound_page()
{
  const std::string page = content(test_folder() / "report.html");
  EXPECT_EQ(unbalanced_tag(page), "");
  has_none(page, {">nan", "nan<", " nan", ">inf", " inf<"});
  for (const auto &entry :
       std::filesystem::directory_iterator(test_folder() / "report"))
    if (entry.path().extension() == ".gp")
      has_none(content(entry.path()), {"nan", "inf"});
  return page;
}

#endif
