# Measured dots and the model's lines, polar, in the plane of incidence.
#   surface, model, legend         texts
#   points, lines                  CSV files, with the number of the curve in column 1
#   curve[], name[], theta_i[]      numbers, names and angles of the curves that are shown
#   largest, decades, ring[]       radius: the value at the outermost circle, decades from the middle or 0 if
#                                  linear, labels
L(v) = decades == 0 ? v / largest : v > 0 ? 1 + log10(v / largest) / decades : 0
R(v) = L(v) < 0 ? 0 : L(v) > 1 ? 1 : L(v)
set label surface at screen 0.03,0.965 left noenhanced font ',17' tc rgb '#111111'
set label model at screen 0.03,0.92 left noenhanced font ',12' tc rgb '#111111'
set label legend at screen 0.03,0.025 left noenhanced font ',12' tc rgb '#111111'
unset border
unset tics
unset grid
set angles degrees
set size ratio -1
set samples 181
set xrange [-1.2:1.2]
set yrange [-0.12:1.12]
set lmargin at screen 0.03
set rmargin at screen 0.97
set tmargin at screen 0.89
set bmargin at screen 0.13
do for [angle=-90:90:15] {
    set arrow from 0,0 to sin(angle),cos(angle) nohead lc rgb '#dddddd' back
    set label sprintf('%d°', angle) at 1.06*sin(angle),1.06*cos(angle) center tc rgb '#555555' font ',12'
}
do for [i=1:|ring|] {
    set label ring[i] at 0.25*i,-0.05 center tc rgb '#555555' font ',12'
}
set key at screen 0.5,0.075 bottom center horizontal samplen 2 font ',12'
command = 'plot sample '
do for [i=1:|ring|] {
    r = sprintf('%g', 0.25 * i)
    command = command . '[a=0:180] "+" using (' . r . '*cos(a)):(' . r . '*sin(a)) ' . \
        'with lines lc rgb "#dddddd" notitle, '
}
do for [i=1:|curve|] {
    picked = sprintf(' every ::1 using ($1 == %d ? R(', curve[i])
    style = sprintf(' lc rgb "%s" ', curve_colour(i, |theta_i|))
    dots = 'points' . picked . '$5)*sin($3) : NaN):(R($5)*cos($3)) with points pt 7 ps 0.42' . style . \
        'notitle, '
    line = 'lines' . picked . '$4)*sin($3) : NaN):(R($4)*cos($3)) with lines lw 2' . style
    command = command . dots . line . sprintf('title name[%d]', i) . (i < |curve| ? ', ' : '')
}
eval command
