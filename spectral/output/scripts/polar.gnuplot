# A half circle of reflectance against view angle: surface normal up, light from the left.
#   title, captions[]            texts
#   data                         CSV with the view angle in column 2 and what is drawn in column 6
#   theta_i[], first[], last[]   per curve: angle of incidence and its records
#   ring[], ring_label[]         circles of the grid, radius 1 the outermost; middle: the label there
#   largest                      what the outermost circle stands for, where the radius is linear
#   decades, top                 else the decades from the middle out, and the power of ten at the outermost
#                                circle
L(v) = 1 + (log10(v) - top) / decades
R(v) = decades == 0 ? v / largest : v > 0 && L(v) > 0 ? L(v) : 0

unset border
unset tics
unset grid
set angles degrees
set size ratio -1
set xrange [-1.32:1.32]
set yrange [-0.44:1.44]
set lmargin at screen 0.02
set rmargin at screen 0.98
set tmargin at screen 0.99
set bmargin at screen 0.01

# Rings, spokes and sides
do for [i=1:|ring|] {
    do for [side=-1:1:2] {
        set label ring_label[i] at side*six(ring[i]),-0.045 center tc rgb '#444444' font ',13'
    }
}
set label middle at 0,-0.045 center tc rgb '#444444' font ',13'
do for [angle=-90:90:15] {
    set arrow from 0,0 to sin(angle),cos(angle) nohead lc rgb (angle % 90 == 0 ? '#888888' : '#d8d8d8') \
        lw 1 back
    if (abs(angle) != 90) {
        set label sprintf('%d°', angle) at 1.055*sin(angle),1.055*cos(angle) center tc rgb '#444444' \
            font ',13'
    }
}
set label 'light side' at -1.32,0.03 left tc rgb '#666666' font ',13'
set label 'mirror side' at 1.32,0.03 right tc rgb '#666666' font ',13'

# An arrow from the light for each curve, outside the circle
do for [i=1:|theta_i|] {
    x = sin(-theta_i[i])
    y = cos(-theta_i[i])
    set arrow from 1.29*x,1.29*y to 1.17*x,1.17*y head filled size 0.035,20,60 lc rgb curve_colour(i, |theta_i|) lw 2.2
}

set label title at -1.3,1.39 left noenhanced tc rgb '#000000' font ',17'
do for [i=1:|captions|] {
    set label captions[i] at 0,-0.145-0.075*(i-1) center tc rgb '#222222' font ',14'
}
set key at screen 0.5,0.02 bottom center horizontal width 1 samplen 2 tc rgb '#000000'
set samples 361
r(i) = six(ring[i])
ring_colour(i) = ring[i] == 1 ? '#888888' : '#d8d8d8'
plot sample \
  [a=0:180] '+' using (r(1)*cos(a)):(r(1)*sin(a)) with lines lw 1 lc rgb ring_colour(1) notitle, \
  for [i=2:|ring|] [a=0:180] '+' using (r(i)*cos(a)):(r(i)*sin(a)) with lines lw 1 \
      lc rgb ring_colour(i) notitle, \
  for [i=1:|theta_i|] data every ::first[i]::last[i] using (R($6)*sin($2)):(R($6)*cos($2)) \
      with lines lw 2.4 lc rgb curve_colour(i, |theta_i|) title sprintf('θ_i = %.15g°', theta_i[i])
