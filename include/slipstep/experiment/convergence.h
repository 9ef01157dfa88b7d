// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_convergence_h
#define slipstep_experiment_convergence_h

#include <limits>
#include <vector>

namespace SlipStep
{
  /// What a sequence of values tends to.
  struct Extrapolation
  {
    double limit = 0.; ///< NaN if the values do not tend to anything
    double order = 0.; ///< p of the error C h^p, NaN then
  };

  /// Richardson extrapolation: limit, C and order p of value = limit + C h^p
  /// from the last three pairs (h, value), whatever the ratios of the sizes h.
  ///
  /// The values must approach the limit from one side, with differences that
  /// fall as fast as orders above 0.1 make them; other triples tell nothing.
  /// @param sizes of mesh or step, falling, in any unit
  Extrapolation richardson(const std::vector<double> &sizes,
                           const std::vector<double> &values);

  /// The order that a sequence shows at its end: that of richardson(), if the
  /// last three differences are monotone and the first two of them show it as
  /// well, within 15 % of the larger of both. NaN else, for it takes two
  /// differences to compute an order and a third one to see that there is one;
  /// and NaN if it is more than one above @p highest: the first error term may
  /// be small, but differences that fall faster still have not come to their
  /// order yet.
  /// @param highest order that the method has for any quantity
  double
  shown_order(const std::vector<double> &sizes,
              const std::vector<double> &values,
              const double highest = std::numeric_limits<double>::infinity());

  /// A value that others are compared with, and how far it may be from the
  /// limit of its sequence.
  struct ReferenceValue
  {
    double value           = 0.; ///< NaN if there is none
    double uncertainty     = 0.; ///< infinite if no limit is in sight
    bool   is_extrapolated = false;
  };

  /// What a sequence tends to: Richardson's limit L, or the last value v_n if
  /// the last three do not have one.
  ///
  /// If three differences show an order, L is uncertain by
  /// \f[ U = \max(|L - L'|, |L - v_n| / 2), \f]
  /// where L' is the limit that the sequence had without its last value: its
  /// error is larger than that of L by the order of what both leave out, so
  /// their difference is about the error of L' and more than that of L. The
  /// second term is for the chance that the two agree by accident.
  ///
  /// Without that evidence only this is used: errors fall at least as fast as
  /// h^q. Then v_j - v_n = C (h_j^q - h_n^q) leaves v_n within
  /// \f[ U_n = \max_{j = n-1, n-2} \frac{|v_j - v_n|}{(h_j/h_n)^q - 1} \f]
  /// of the limit, and L within U_n + |L - v_n|. Two differences are taken
  /// because one may be small by accident. q is 1/2; if there are but three
  /// values, it is half the order of L, between 1/2 and 1. If differences have
  /// one sign and do not fall, no limit is in sight; below 1e-4 of the value,
  /// though, 50 of them are taken, since no sequence goes on for longer.
  /// @param highest see shown_order()
  ReferenceValue extrapolated_reference(
    const std::vector<double> &sizes,
    const std::vector<double> &values,
    const double highest = std::numeric_limits<double>::infinity());

  /// The last value as reference for the others: within |v_n - L| + U of the
  /// limit if three differences show an order, else within U_n (see above).
  ReferenceValue finest_reference(
    const std::vector<double> &sizes,
    const std::vector<double> &values,
    const double highest = std::numeric_limits<double>::infinity());
} // namespace SlipStep

#endif
