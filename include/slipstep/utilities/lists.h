// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_lists_h
#define slipstep_utilities_lists_h

#include <boost/algorithm/cxx11/all_of.hpp>
#include <boost/algorithm/cxx11/any_of.hpp>
#include <boost/algorithm/cxx11/none_of.hpp>
#include <boost/range/algorithm/count_if.hpp>
#include <boost/range/algorithm/sort.hpp>
#include <boost/range/algorithm/stable_sort.hpp>
#include <boost/range/algorithm_ext/erase.hpp>

namespace SlipStep
{
  /// @name Algorithms of the standard library, for whole lists
  ///@{
  using boost::algorithm::all_of;
  using boost::algorithm::any_of;
  using boost::algorithm::none_of;
  using boost::range::count_if;
  using boost::range::remove_erase_if;
  using boost::range::sort;
  using boost::range::stable_sort;

  template <typename List, typename Value>
  bool holds(const List &list, const Value &value)
  {
    return boost::algorithm::any_of_equal(list, value);
  }
  ///@}
} // namespace SlipStep

#endif
