// How the effects of the catalogue are tried: formulas, bounds, first guesses.

#include <deal.II/base/numbers.h>

#include <slipstep/diagnosis/candidate_makers.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  bool Circumstances::has(const std::string &effect) const
  {
    const std::vector<std::string> list = parameters.list("Friction/Effects");
    return std::find(list.begin(), list.end(), effect) != list.end();
  }



  bool Circumstances::has_flow_rule() const
  {
    return has("overstress") || has("perzyna");
  }



  bool Circumstances::is_fitted(const std::string &path) const
  {
    return parameters.text("Calibration/Parameters").find(path + " ") !=
           std::string::npos;
  }



  void Circumstances::set(Formula           &formula,
                          const std::string &path,
                          const double       value) const
  {
    formula.settings[path] = quantity_text(parameters, path, value);
  }



  double Circumstances::number(const std::string &path) const
  {
    return parameters.number(path);
  }



  double Circumstances::friction() const
  {
    return range.typical_friction;
  }



  void leave_to_model(Candidate &candidate, const std::string &why)
  {
    candidate.formulas.clear();
    candidate.why_not     = why;
    candidate.is_in_model = true;
  }



  namespace
  {
    using dealii::numbers::PI;

    const char *const static_key  = "Friction/Static coefficient";
    const char *const kinetic_key = "Friction/softening/Kinetic coefficient";

    /// What a change of friction by one per cent is made of: the size of all
    /// trial strengths.
    constexpr double just_noticed = 0.01;



    // Values from a to b, each the same factor from the next.
    std::vector<double>
    ladder(const double a, const double b, const unsigned int n)
    {
      std::vector<double> values;
      for (unsigned int i = 0; i < n; ++i)
        values.push_back(n == 1 ? std::sqrt(a * b) :
                                  a * std::pow(b / a, i / (n - 1.)));
      return values;
    }



    // One parameter in proportion to the strength, @p unit of it changing
    // friction by its own size.
    void set_proportional(Formula           &formula,
                          const std::string &path,
                          const double       unit,
                          const double       lower,
                          const double       upper)
    {
      // A start within the bounds.
      const double margin = 0.03 * (upper - lower);
      const double least  = lower < 0. ? lower + margin : 0.;
      formula.parameters  = {{path, lower, upper, false}};
      formula.shapes      = {{[=](const double strength) {
        return std::map<std::string, double>{
          {path,
           std::clamp(just_noticed * strength * unit, least, upper - margin)}};
      }}};
    }



    // ------------------------------------------------------ rate

    // r - r_s is about ln(1 + eta_v V (r_m - r)) / n.
    Formula overstress_formula(const Circumstances &now)
    {
      Formula formula;
      formula.effect              = "overstress";
      formula.is_one_sided        = true;
      const std::string viscosity = "Friction/overstress/Viscosity";
      const std::string exponent  = "Friction/overstress/Exponent";
      formula.parameters          = {{viscosity,
                                      1e-2 / now.range.fastest,
                                      1e6 / now.range.slowest,
                                      true,
                                      true,
                                      true},
                                     {exponent, 2., 1e4, true}};
      for (const double eta :
           ladder(0.3 / now.range.fastest, 1e4 / now.range.slowest, 5))
        {
          const double rise =
            std::log1p(eta * now.range.fastest * 0.8) / just_noticed;
          formula.shapes.push_back({[=](const double strength) {
            return std::map<std::string, double>{
              {viscosity, eta},
              {exponent,
               std::clamp(rise / std::max(strength, 1e-3), 2.5, 9e3)}};
          }});
        }
      return formula;
    }



    // r - r_s = (eta V)^(1/n).
    Formula perzyna_formula(const Circumstances &now)
    {
      Formula formula;
      formula.effect              = "perzyna";
      formula.is_one_sided        = true;
      const std::string viscosity = "Friction/perzyna/Viscosity";
      const std::string exponent  = "Friction/perzyna/Exponent";
      const double      speed     = now.range.fastest;
      formula.parameters = {{viscosity, 1e-30 / speed, 1e6 / speed, true},
                            {exponent, 2., 16., true, true, true}};
      for (const double n : {2., 4., 8.})
        formula.shapes.push_back({[=](const double strength) {
          const double rise = std::clamp(just_noticed * strength, 1e-3, 3.);
          return std::map<std::string, double>{{viscosity,
                                                std::pow(rise, n) / speed},
                                               {exponent, n}};
        }});
      return formula;
    }



    Candidate overstress(const Circumstances &now)
    {
      Candidate candidate{
        "overstress",
        "the same step in every phase, linear in ln V, the same both ways",
        {},
        ""};
      if (now.has_flow_rule())
        leave_to_model(candidate, "the model has a flow rule already");
      else
        candidate.formulas = {overstress_formula(now), perzyna_formula(now)};
      return candidate;
    }



    Candidate stribeck(const Circumstances &now)
    {
      Candidate candidate{"stribeck",
                          "slow speeds high, no memory of holds",
                          {},
                          ""};
      Formula   formula;
      formula.effect             = "stribeck";
      formula.is_one_sided       = true;
      const std::string rise     = "Friction/stribeck/Rise";
      const std::string speed    = "Friction/stribeck/Speed";
      const std::string exponent = "Friction/stribeck/Exponent";
      formula.parameters         = {
                {rise, 0., 3., false},
                {speed, 0.1 * now.range.slowest, 10. * now.range.fastest, true},
                {exponent, 1., 3., false, true, false}};
      for (const double V :
           ladder(0.7 * now.range.slowest, 1.5 * now.range.fastest, 6))
        formula.shapes.push_back({[=](const double strength) {
          return std::map<std::string, double>{
            {rise, std::clamp(just_noticed * strength, 1e-4, 2.9)},
            {speed, V},
            {exponent, 1.2}};
        }});
      candidate.formulas = {formula};
      return candidate;
    }



    Candidate viscous(const Circumstances &now)
    {
      Candidate candidate{"viscous",
                          "linear in V, its share shrinks with pressure",
                          {},
                          ""};
      Formula   formula;
      formula.effect       = "viscous";
      formula.is_one_sided = true;
      const double unit =
        now.friction() * now.range.highest / now.range.fastest;
      set_proportional(formula, "Friction/viscous/Drag", unit, 0., 3. * unit);
      candidate.formulas = {formula};
      return candidate;
    }



    // ------------------------------------------------------ history

    // A fall from above the friction that the model has.
    Candidate softening(const Circumstances &now)
    {
      Candidate candidate{"softening",
                          "exponential in slip, never comes back",
                          {},
                          ""};
      Formula   formula;
      formula.effect              = "softening";
      formula.is_one_sided        = true;
      const std::string rate      = "Friction/softening/Rate";
      const std::string steepness = "Friction/softening/Steepness";
      const double      mu        = now.number(static_key);
      // Next to an exponential only the product of both is felt.
      const double least_steep = 0.1 / mu, steepest = 30. / mu;
      formula.parameters = {
        {static_key, 0.2 * mu, 5. * mu, false},
        {kinetic_key, 0.1 * mu, 5. * mu, false},
        {rate,
         0.1 / (now.range.longest_path * steepest),
         1e4 / (now.range.longest_path * least_steep),
         true,
         true,
         true},
        {steepness, least_steep, steepest, true, true, true}};
      for (const double length : ladder(0.003 * now.range.longest_path,
                                        0.5 * now.range.longest_path,
                                        5))
        formula.shapes.push_back({[=](const double strength) {
          const double fall = std::clamp(just_noticed * strength, 1e-4, 2.);
          return std::map<std::string, double>{{static_key, mu * (1. + fall)},
                                               {kinetic_key, mu},
                                               {rate, mu / length},
                                               {steepness, 1. / mu}};
        }});
      candidate.formulas = {formula};
      return candidate;
    }



    // xi such that a share of the fall comes back in the longest rest.
    double healing_rate(const double fall,
                        const double steepness,
                        const double rest,
                        const double share)
    {
      return std::log(std::expm1(-steepness * fall) /
                      std::expm1(-steepness * fall * (1. - share))) /
             (steepness * rest);
    }



    double long_rest(const Circumstances &now)
    {
      return now.range.longest_rest > 0. ? now.range.longest_rest :
                                           now.range.longest_test;
    }



    // The peak fades as softening does.
    Formula recovery_formula(const Circumstances &now)
    {
      Formula formula;
      if (!now.has("healing"))
        formula.effect = "healing";
      formula.is_one_sided        = true;
      const std::string rate      = "Friction/healing/Rate";
      const std::string steepness = "Friction/healing/Steepness";
      const double      fall =
        std::max(now.number(static_key) - now.number(kinetic_key),
                 0.01 * now.number(static_key));
      formula.parameters = {
        {rate, 1e-14, 1e2, true},
        {steepness, 0.3 / fall, 25. / fall, true, true, true}};
      for (const double x : {0.5, 3., 8.})
        for (const double share : {0.1, 0.5})
          formula.shapes.push_back(
            {[=, rest = long_rest(now)](const double strength) {
              return std::map<std::string, double>{
                {rate,
                 healing_rate(fall,
                              x / fall,
                              rest,
                              std::clamp(share * strength, 0.003, 0.97))},
                {steepness, x / fall}};
            }});
      return formula;
    }



    // The peak fades on a length of its own, which is not longer than what
    // touches: otherwise it is a drift, which has other names.
    Formula ageing_formula(const Circumstances &now)
    {
      constexpr double shortest = 1e-4, longest = 1.; // [mm]

      Formula formula;
      if (!now.has("ageing"))
        formula.effect = "ageing";
      formula.is_one_sided     = true;
      const std::string growth = "Friction/ageing/Growth";
      const std::string time   = "Friction/ageing/Time";
      const std::string length = "Friction/ageing/Renewal length";
      const double      rest   = long_rest(now);
      formula.parameters       = {{growth, 0., 1., false},
                                  {time, 1e-4 * rest, 10. * rest, true, true, true},
                                  {length, shortest, longest, true}};
      for (const double t_0 : {0.01 * rest, 0.3 * rest})
        for (const double L : ladder(0.01, 0.5, 3))
          formula.shapes.push_back({[=](const double strength) {
            return std::map<std::string, double>{
              {growth,
               std::clamp(just_noticed * strength / std::log1p(rest / t_0),
                          1e-6,
                          0.9)},
              {time, t_0},
              {length, L}};
          }});
      return formula;
    }



    Candidate healing(const Circumstances &now)
    {
      Candidate candidate{
        "healing",
        "a peak after a hold that grows with the logarithm of its time, gone "
        "after some slip",
        {},
        ""};
      if ((now.has("healing") && now.number("Friction/healing/Rate") > 0.) ||
          (now.has("ageing") && now.number("Friction/ageing/Growth") > 0.))
        {
          leave_to_model(candidate, "it is in the model already");
          return candidate;
        }
      // Without softening there is no fall to recover from.
      if (now.has("softening"))
        candidate.formulas.push_back(recovery_formula(now));
      // Without rests it is an effect of the speed, which has other names.
      if (now.range.longest_rest > 0.)
        candidate.formulas.push_back(ageing_formula(now));
      if (candidate.formulas.empty())
        candidate.why_not = "nothing rested, and without softening nothing can "
                            "recover";
      return candidate;
    }



    // A fall with the path is softening by another name: without softening in
    // the model only a rise is run-in.
    Candidate run_in(const Circumstances &now)
    {
      Candidate candidate{"run_in",
                          "slow drift with the path, no recovery",
                          {},
                          ""};
      Formula   formula;
      formula.effect           = "run_in";
      formula.is_one_sided     = !now.has("softening");
      const std::string change = "Friction/run_in/Change";
      const std::string length = "Friction/run_in/Length";
      const double      path   = now.range.longest_path;
      formula.parameters       = {
              {change, formula.is_one_sided ? 0. : -0.8, 3., false},
              {length, 0.02 * path, 10. * path, true, false, true}};
      for (const double D : ladder(0.03 * path, 3. * path, 5))
        formula.shapes.push_back({[=](const double strength) {
          return std::map<std::string, double>{
            {change, std::clamp(just_noticed * strength, -0.7, 2.9)},
            {length, D}};
        }});
      candidate.formulas = {formula};
      return candidate;
    }



    // Only the product of weakening and heating is felt.
    Candidate heating(const Circumstances &now)
    {
      Candidate candidate{
        "heating",
        "falls inside a fast run, recovers in a pause, repeats",
        {},
        ""};
      Formula formula;
      formula.effect              = "heating";
      formula.is_one_sided        = true;
      const std::string heating   = "Friction/heating/Heating";
      const std::string cooling   = "Friction/heating/Cooling time";
      constexpr double  weakening = 1e-3;
      now.set(formula, "Friction/heating/Weakening", weakening);
      const double power =
        now.friction() * now.range.highest * now.range.fastest;
      const double shortest =
        std::min(now.range.longest_test,
                 now.range.longest_path / now.range.fastest);
      formula.parameters = {{heating,
                             1e-6 /
                               (weakening * power * now.range.longest_test),
                             1e3 / (weakening * power * shortest),
                             true},
                            {cooling,
                             0.03 * shortest,
                             3. * now.range.longest_test,
                             true,
                             false,
                             true}};
      for (const double t : ladder(0.1 * shortest, now.range.longest_test, 6))
        formula.shapes.push_back({[=](const double strength) {
          return std::map<std::string, double>{
            {heating,
             std::clamp(just_noticed * strength, 1e-4, 10.) /
               (weakening * power * std::min(t, shortest))},
            {cooling, t}};
        }});
      candidate.formulas = {formula};
      return candidate;
    }



    // ------------------------------------------------------ pressure

    Candidate pressure(const Circumstances &now)
    {
      Candidate candidate{"pressure", "straight in ln p only", {}, ""};
      Formula   formula;
      formula.effect = "pressure";
      now.set(formula,
              "Friction/pressure/Reference pressure",
              std::sqrt(now.range.lowest * now.range.highest));
      set_proportional(formula, "Friction/pressure/Exponent", 1., -0.8, 0.8);
      candidate.formulas = {formula};
      return candidate;
    }



    // tanh(x) / x is about 1 - x^2 / 3.
    Candidate shear_cap(const Circumstances &now)
    {
      Candidate candidate{"shear_cap", "only high pressures bend", {}, ""};
      Formula   formula;
      formula.effect            = "shear_cap";
      formula.is_one_sided      = true;
      const std::string limit   = "Friction/shear_cap/Shear limit";
      const double      largest = now.friction() * now.range.highest;
      formula.parameters = {{limit, 0.2 * largest, 100. * largest, true}};
      formula.shapes     = {{[=](const double strength) {
        return std::map<std::string, double>{
          {limit,
           std::clamp(largest /
                        std::sqrt(3. * just_noticed * std::max(strength, 1e-3)),
                      0.25 * largest,
                      90. * largest)}};
      }}};
      candidate.formulas = {formula};
      return candidate;
    }



    Candidate adhesion(const Circumstances &now)
    {
      Candidate candidate{"adhesion",
                          "only low pressures rise, as 1/p",
                          {},
                          ""};
      Formula   formula;
      formula.effect       = "adhesion";
      formula.is_one_sided = true;
      const double unit    = now.friction() * now.range.lowest;
      set_proportional(
        formula, "Friction/adhesion/Strength", unit, 0., 2. * unit);
      candidate.formulas = {formula};
      return candidate;
    }



    // ------------------------------------------------------ direction

    Candidate anisotropy(const Circumstances &)
    {
      Candidate candidate{"anisotropy", "a ratio in off-axis tests", {}, ""};
      Formula   formula;
      formula.effect          = "anisotropy";
      const std::string ratio = "Friction/anisotropy/Ratio";
      const std::string angle = "Friction/anisotropy/Angle";
      formula.parameters      = {{ratio, 0.3, 3., true},
                                 {angle, -PI / 4., PI / 4., false, true, true}};
      for (const double phi : {0., 0.9 * PI / 4.})
        formula.shapes.push_back({[=](const double strength) {
          return std::map<std::string, double>{
            {ratio, std::clamp(1. + just_noticed * strength, 0.35, 2.9)},
            {angle, phi}};
        }});
      candidate.formulas = {formula};
      return candidate;
    }



    Candidate direction(const Circumstances &)
    {
      Candidate candidate{"direction", "an offset on reverse strokes", {}, ""};
      Formula   formula;
      formula.effect = "direction";
      set_proportional(formula, "Friction/direction/Change", 1., -0.8, 3.);
      candidate.formulas = {formula};
      return candidate;
    }



    // ------------------------------------------------------ stiffness

    // A spring in series with the contact's own stiffness: for a contact point
    // the same as a smaller alpha_t, which the block understands, too.
    Candidate compliance(const Circumstances &now)
    {
      Candidate         candidate{"compliance", "loading flanks only", {}, ""};
      const std::string stiffness = "Friction/Tangential stiffness";
      if (now.is_fitted(stiffness) ||
          now.is_fitted("Loading/Machine stiffness"))
        {
          leave_to_model(candidate, "the stiffness is fitted already");
          return candidate;
        }
      Formula formula;
      formula.is_one_sided = true;
      const double alpha   = now.number(stiffness);
      // A flank longer by a thousandth of the path.
      const double unit =
        1e-4 * now.range.longest_path / (now.friction() * now.range.highest);
      const double softest =
        now.friction() * now.range.highest / (0.3 * now.range.longest_path);
      formula.parameters = {
        {stiffness, std::min(softest, 0.1 * alpha), alpha, true}};
      formula.shapes     = {{[=](const double strength) {
        return std::map<std::string, double>{
          {stiffness,
           std::max(1. / (1. / alpha + unit * std::max(strength, 1e-3)),
                    1.01 * std::min(softest, 0.1 * alpha))}};
      }}};
      candidate.formulas = {formula};
      return candidate;
    }



    // The smooth onset of slip.
    Candidate subloading(const Circumstances &now)
    {
      Candidate candidate{"subloading",
                          "rounded flanks before every peak",
                          {},
                          ""};
      Formula   formula;
      formula.effect         = "subloading";
      formula.is_one_sided   = true;
      const std::string rate = "Friction/subloading/Rate";
      const double      unit = 100. / now.range.longest_path;
      formula.parameters     = {{rate, 0.01 * unit, 1e5 * unit, true}};
      for (const double u : {1., 30.})
        formula.shapes.push_back({[=](const double strength) {
          return std::map<std::string, double>{
            {rate,
             std::clamp(u * unit / std::max(strength, 1e-3),
                        0.011 * unit,
                        9e4 * unit)}};
        }});
      candidate.formulas = {formula};
      return candidate;
    }
  } // namespace



  const std::vector<std::pair<std::string, Maker>> &candidate_makers()
  {
    static const std::vector<std::pair<std::string, Maker>> list = {
      {"overstress", overstress},
      {"softening", softening},
      {"healing", healing},
      {"pressure", pressure},
      {"shear_cap", shear_cap},
      {"adhesion", adhesion},
      {"heating", heating},
      {"run_in", run_in},
      {"anisotropy", anisotropy},
      {"direction", direction},
      {"stribeck", stribeck},
      {"viscous", viscous},
      {"compliance", compliance},
      {"subloading", subloading}};
    return list;
  }
} // namespace SlipStep
