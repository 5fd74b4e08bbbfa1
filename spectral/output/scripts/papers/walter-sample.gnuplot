# One of Figs 10, 11, 13 and 14 of Walter et al. 2007: what a glass transmits, and its normals.
#   title, caption   texts
#   lobes, normals   CSV files; of the lobes columns 2, 4, … are Beckmann's and 3, 5, … GGX's, a pair per
#                    angle of incidence
#   incidences       how many angles
#   widest           normal that is shown [deg]
set samples 2
set multiplot layout 1,2 margins 0.08,0.975,0.13,0.82 spacing 0.095,0.1
set label title at screen 0.015,0.955 left noenhanced font ',18' tc rgb '#111111'
set label caption at screen 0.015,0.9 left noenhanced font ',13' tc rgb '#111111'
set xlabel 'transmitted angle θ_o [°]'
set ylabel 'f_t |o·n| [1/sr]'
set xrange [-30:90]
set xtics 30
set yrange [0:*]
command = 'plot '
do for [k=1:incidences] {
    command = command . (k == 1 ? '' : ', ') . \
        sprintf('lobes using 1:%d every ::1 with lines lw 2.4 lc rgb "#009e73" ', 2*k+1) . \
        (k == 1 ? 'title "GGX", ' : 'notitle, ') . \
        sprintf('lobes using 1:%d every ::1 with lines lw 2 dt 2 lc rgb "#d55e00" ', 2*k) . \
        (k == 1 ? 'title "Beckmann"' : 'notitle')
}
eval command
unset label
set xlabel 'θ_m [°]'
set ylabel 'D, scaled [1/sr]'
set xrange [0:widest]
set xtics autofreq
plot normals using 1:3 every ::1 with lines lw 2.4 lc rgb '#009e73' title 'GGX', \
     normals using 1:2 every ::1 with lines lw 2 dt 2 lc rgb '#d55e00' title 'Beckmann'
unset multiplot
