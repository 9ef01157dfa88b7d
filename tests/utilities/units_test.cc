// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/units.h>

#include <gtest/gtest.h>

#include "tests/file_text.h"

using namespace SlipStep;

namespace
{
  std::string error_of(const std::string &text,
                       const Dimension    dimension,
                       const bool         unit_required = false)
  {
    try
      {
        parse_quantity(text, dimension, unit_required);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace



TEST(Units, ConvertToBaseUnits)
{
  EXPECT_EQ(parse_quantity("5.8 MPa", Dimension::stress), 5.8);
  EXPECT_EQ(parse_quantity("2 GPa", Dimension::stress), 2000.);
  EXPECT_EQ(parse_quantity("60 mm/min", Dimension::speed), 1.);
  EXPECT_EQ(parse_quantity("-1 mm/min", Dimension::speed), -1. / 60.);
  EXPECT_EQ(parse_quantity("3 um", Dimension::length), 3e-3);
  EXPECT_EQ(parse_quantity("2h", Dimension::time), 7200.);
  EXPECT_EQ(parse_quantity("1 1/m", Dimension::per_length), 1e-3);
  EXPECT_EQ(parse_quantity("4 GPa/m", Dimension::stiffness), 4.);
  EXPECT_EQ(parse_quantity("3 s/m", Dimension::viscosity), 3e-3);
  // The international yard and pound of 1959, standard gravity.
  EXPECT_EQ(parse_quantity("2 inch", Dimension::length), 50.8);
  EXPECT_DOUBLE_EQ(parse_quantity("30 in/min", Dimension::speed), 12.7);
  EXPECT_DOUBLE_EQ(parse_quantity("3 cm/min", Dimension::speed), 0.5);
  EXPECT_NEAR(parse_quantity("1000 psi", Dimension::stress),
              6.89475729317,
              1e-10);
  EXPECT_NEAR(parse_quantity("1 ksi", Dimension::stress), 6.89475729317, 1e-10);
  EXPECT_EQ(parse_quantity("3 daN", Dimension::force), 30.);
  EXPECT_DOUBLE_EQ(parse_quantity("2 in^2", Dimension::area), 1290.32);
  EXPECT_DOUBLE_EQ(parse_quantity("1 lbf", Dimension::force) /
                     parse_quantity("1 in^2", Dimension::area),
                   parse_quantity("1 psi", Dimension::stress));
  EXPECT_EQ(parse_quantity("6 1/min", Dimension::per_time), 0.1);
  EXPECT_DOUBLE_EQ(parse_quantity("180 deg", Dimension::angle),
                   dealii::numbers::PI);
  EXPECT_DOUBLE_EQ(parse_quantity("2 rad", Dimension::angle), 2.);
}



TEST(Units, ABareNumberIsInTheBaseUnit)
{
  EXPECT_EQ(parse_quantity(" 0.045 ", Dimension::per_length), 0.045);
  EXPECT_EQ(parse_quantity("+1e-3", Dimension::number), 1e-3);
  EXPECT_EQ(base_unit(Dimension::stiffness), "MPa/mm");
  EXPECT_EQ(base_unit(Dimension::number), "");
}



TEST(Units, MessagesNameWhatIsKnown)
{
  EXPECT_TRUE(
    contains(error_of("5", Dimension::stress, true), "unit is missing"));
  EXPECT_TRUE(contains(error_of("5 mpa", Dimension::stress), "nearest is MPa"));
  const std::string wrong = error_of("5 parsec", Dimension::speed);
  EXPECT_TRUE(contains(wrong, "\"parsec\" is not a unit of a speed"));
  EXPECT_TRUE(contains(wrong, "mm/min"));
  for (const char *text : {"", "fast", "1,5 mm", "nan", "inf", "1e999", "0x10"})
    EXPECT_NE(error_of(text, Dimension::length), "") << text;
  EXPECT_NE(error_of("3 mm", Dimension::number), "");
}



TEST(Units, QuantityKeepsItsBounds)
{
  const Quantity ratio(Dimension::number, 1., 10., true);
  EXPECT_FALSE(ratio.match("1"));
  EXPECT_TRUE(ratio.match("1.0001"));
  EXPECT_TRUE(ratio.match("10"));
  EXPECT_FALSE(ratio.match("10.1"));
  EXPECT_EQ(ratio.description(), "a number greater than 1 and at most 10");

  EXPECT_EQ(Quantity(Dimension::length, 0., 1e30, true).description(),
            "a length (in mm if no unit is given) greater than 0 mm");

  // Bounds of angles are in degrees, also where radians would be rounded.
  const Quantity angle(Dimension::angle, -90., 90.);
  EXPECT_TRUE(angle.match("90 deg"));
  EXPECT_FALSE(angle.match("90.01 deg"));
  EXPECT_FALSE(angle.match("2 rad"));
  EXPECT_DOUBLE_EQ(angle.value("90 deg"), dealii::numbers::PI / 2.);

  const Quantity speed(
    Dimension::speed, 0., std::numeric_limits<double>::infinity(), true, true);
  EXPECT_FALSE(speed.match("3"));
  EXPECT_TRUE(speed.clone()->match("3 mm/s"));
  EXPECT_FALSE(speed.clone()->match("3"));
  EXPECT_TRUE(contains(speed.why_not("0 mm/s"), "out of range"));
}



TEST(Units, ColumnsOfFilesAreConverted)
{
  EXPECT_EQ(unit_conversion("uN", Dimension::force)(5e6), 5.);
  EXPECT_EQ(unit_conversion("\xC2\xB5m", Dimension::length)(2.), 2e-3);
  EXPECT_EQ(unit_conversion("\xB5m/s", Dimension::speed)(2.), 2e-3);
  EXPECT_EQ(unit_conversion(" N/mm\xC2\xB2", Dimension::stress)(3.), 3.);
  EXPECT_EQ(unit_conversion("\xC2\xB0"
                            "C",
                            Dimension::temperature)(25.),
            25.);
  EXPECT_EQ(unit_conversion("K", Dimension::temperature)(273.15), 0.);
  EXPECT_EQ(parse_quantity("300 K", Dimension::temperature), 300. - 273.15);
  EXPECT_EQ(parse_quantity("3 cm^2", Dimension::area), 300.);
}



TEST(Units, AnUnknownUnitOfAColumnComesWithTheNearest)
{
  try
    {
      unit_conversion("MPas", Dimension::stress);
      FAIL();
    }
  catch (const InputError &error)
    {
      EXPECT_TRUE(contains(std::string(error.what()), "nearest is MPa"))
        << error.what();
    }
  EXPECT_THROW(unit_conversion("N", Dimension::number), InputError);
}
