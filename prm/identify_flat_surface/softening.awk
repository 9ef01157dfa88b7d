# SPDX-License-Identifier: LGPL-2.1-or-later
# A test at 1 mm/min by the closed form of eq. 2 without healing, mu(s), times
# the loading ratio r of eq. 3 at this speed. Needs seed, noise.
function flow(r) {  # eq. 3: the speed [mm/s] at a loading ratio
  return (exp(16.52*(r - 1)) - 1)/(1.15e4*(1.8 - r))
}
BEGIN {
  low = 1; high = 1.8
  while (high - low > 1e-14) {
    r = (low + high)/2
    if (flow(r) < 1/60) low = r; else high = r
  }
  kappa = 0.045; a = 1
  mu_s = 0.115/r; mu_k = 0.098/r  # Table 2 was read at 1 mm/min
  heading("softening, noise " noise, "1 mm/min, noise " noise,
    "generated from the closed form of eq. 2 with Table 2, normal noise of " noise " added; not measured")
  if (noise > 0) print "# noise: " noise
  columns()
  for (i = 0; i <= 500; ++i) {
    s = 0.2*i
    mu = mu_k - log(1 - (1 - exp(-a*(mu_s - mu_k)))*exp(-a*kappa*s))/a
    printf "%.6g,%.6g,5.8,%.9f\n", 60*s, s, r*mu + noise*normal()
  }
}
