# Draws the traction of the run against the ellipse of README.md:
#   gnuplot prm/anisotropic_path/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/anisotropic_path/point'

# The numbers of anisotropic_path.prm.
mu = 0.1; rho = 0.6; V = 10./60
eta = 1.15e4; n = 16.52; r_m = 1.8

# The ellipse at the slip rate of each direction of motion: a step of Newton's
# method after the other for eta V' (r_m - r) = exp(n (r - 1)) - 1.
newton(r, v) = r - (exp(n*(r - 1)) - 1 - eta*v*(r_m - r))/(n*exp(n*(r - 1)) + eta*v)
n3(r, v) = newton(newton(newton(r, v), v), v)
ratio(v) = n3(n3(n3(1.5, v), v), v)
s(t) = sqrt(cos(t)**2 + (rho*sin(t))**2)
f(t) = mu*ratio(V*s(t))/s(t)

set encoding utf8
set terminal svg enhanced size 860,560 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set datafile separator ','
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set parametric
set trange [0:2*pi]
set samples 400
set size ratio -1
set xlabel 'Friction along the first axis'
set ylabel 'Friction along the second axis'
set xrange [-0.18:0.18]
set yrange [-0.13:0.13]
set key outside right top Left reverse samplen 2.5 spacing 1.25
set output folder.'/ellipse.svg'
array angle[7] = [0, 15, 30, 45, 60, 75, 90]
do for [i = 1:7] {
  t = angle[i]*pi/180
  set arrow i from f(t)*cos(t), f(t)*rho**2*sin(t) rto 0.025*cos(t), 0.025*sin(t) \
    head filled size screen 0.012,20 lw 2 lc rgb '#D55E00' front
}
plot f(t)*cos(t), f(t)*rho**2*sin(t) with lines lw 5 lc rgb '#bbbbbb' title 'closed form', \
  folder.'/history.csv' using (column('friction')):(column('friction_y')) \
    with lines lw 1.5 lc rgb '#0072B2' title 'slipstep', \
  NaN, NaN with lines lw 2 lc rgb '#D55E00' title 'direction of motion'
set output
