# ln(model / measured) of every point.
#   surface, model, legend   texts
#   points                   CSV file
#   scattered                1: against the tilt of the facets, else the swept angle, coloured by the fixed
#                            one
#   swept, fixed             what the axes are
set label surface at screen 0.03,0.965 left noenhanced font ',17' tc rgb '#111111'
set label model at screen 0.03,0.92 left noenhanced font ',12' tc rgb '#111111'
set label legend at screen 0.03,0.025 left noenhanced font ',12' tc rgb '#111111'
set tmargin at screen 0.88
set bmargin at screen 0.2
set lmargin at screen 0.09
set rmargin at screen (scattered ? 0.97 : 0.86)
set xlabel swept
set ylabel 'ln(model / measured)'
set xzeroaxis lc rgb '#444444' lw 1
set palette defined (0 '#0072b2', 0.5 '#009e73', 1 '#e69f00')
set cblabel fixed
set yrange [-3.1:3.1]
r(v) = v > 3 ? 3 : v < -3 ? -3 : v
f(x) = 0.25
g(x) = -0.25
if (scattered) {
    plot f(x) with lines dt 2 lc rgb '#999999' title '±0.25', g(x) with lines dt 2 lc rgb '#999999' notitle, \
        points every ::1 using 4:(r($8)) with points pt 7 ps 0.6 lc rgb '#0072b2' notitle
} else {
    plot f(x) with lines dt 2 lc rgb '#999999' title '±0.25', g(x) with lines dt 2 lc rgb '#999999' notitle, \
        points every ::1 using 3:(r($8)):2 with points pt 7 ps 0.45 lc palette notitle
}
