# Lobes of random profiles, exact and in closed form: a panel per surface and angle of incidence.
#   title                                      text
#   roughness[], length[], theta_i[], top[]    of the panels, the last the end of its axis [dB]
#   polarised                                  1: TE and TM of this model; 0: this model and two others, of
#                                              unpolarised light
#   $lobes                                     angle of scattering, exact TE, exact TM, closed forms [dB]; an
#                                              index per panel
columns = 2
rows = (|top| + 1) / columns
height = 220 + 218 * rows
down(pixels) = 1 - pixels / (1. * height)
set terminal svg size 1000,height font 'Helvetica,14' background '#ffffff'
set output picture
set label title at screen 0.015,down(27) left noenhanced font ',19' tc rgb '#111111'
set label 'Incoherent power per angle [dB re 1/rad], averages over 5°; negative angles: the side of the ' . \
    'source.' \
    at screen 0.015,down(54) left noenhanced font ',13' tc rgb '#111111'
set multiplot layout rows,columns margins 0.085,0.97,six(1-down(82)),six(down(136)) spacing 0.07,six(60./height)
set xrange [-90:90]
set xtics 30
set key at screen 0.97,down(90) right bottom horizontal samplen 1.6 font ',12'
set ytics 10
do for [i=0:|top|-1] {
    set yrange [top[i + 1]-40:top[i + 1]]
    set title sprintf('σ_0 = %.6g λ, τ = %.6g λ, θ_i = %.6g°', roughness[i + 1], length[i + 1], theta_i[i + \
        1]) font ',13' offset 0,-0.8
    set ylabel (i % columns == 0 ? 'power [dB re 1/rad]' : '') offset 1,0
    if (i + columns >= |top|) { set xlabel 'angle of scattering [°]' offset 0,0.5 }
    if (polarised) {
        plot $lobes index i using 1:2 with points pt 7 ps 0.45 lc rgb '#000000' title 'exact, TE', \
            $lobes index i using 1:3 with points pt 6 ps 0.5 lc rgb '#000000' title 'exact, TM', \
            $lobes index i using 1:4 with lines lw 2.4 lc rgb '#0072b2' title 'this model, TE', \
            $lobes index i using 1:5 with lines lw 2.4 dt 2 lc rgb '#0072b2' title 'this model, TM'
    } else {
        plot $lobes index i using 1:2 with points pt 7 ps 0.45 lc rgb '#000000' title 'exact, TE', \
            $lobes index i using 1:3 with points pt 6 ps 0.5 lc rgb '#000000' title 'exact, TM', \
            $lobes index i using 1:4 with lines lw 2 dt 2 lc rgb '#009e73' title 'Kirchhoff', \
            $lobes index i using 1:5 with lines lw 2.6 lc rgb '#0072b2' title 'this model', \
            $lobes index i using 1:6 with lines lw 2 lc rgb '#d55e00' title 'Smith, correlated'
    }
    set key off
    unset label
}
unset multiplot
