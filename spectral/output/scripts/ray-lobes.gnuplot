# Light that explicit surfaces of mirrors reflect once; a row of panels per slope, a column per angle of
# incidence.
#   slope[], theta_i[]   of rows and columns
#   $lobes               angle of reflection, traced, this model, heights correlated; an index per panel
set terminal svg size 1000,120+240*|slope| font 'Helvetica,14' background '#ffffff'
set output picture
set label 'Light reflected once by explicit surfaces of perfect mirrors' \
    at screen 0.015,0.965 left noenhanced font ',19' tc rgb '#111111'
set label 'BRDF x cos θr [1/sr] within 15° of the plane of incidence; negative angles: the side of the ' . \
    'source.' \
    at screen 0.015,0.93 left noenhanced font ',13' tc rgb '#111111'
set multiplot layout |slope|,|theta_i| margins 0.075,0.98,0.09,0.87 spacing 0.06,0.1
set xrange [-90:90]
set xtics 30
set yrange [0:*]
set key at screen 0.985,0.985 right top vertical samplen 2 font ',12'
do for [i=0:|slope|*|theta_i|-1] {
    set title sprintf('σ_0/τ = %.6g, θ_i = %.6g°', slope[i / |theta_i| + 1], theta_i[i % |theta_i| + 1]) \
        font ',13' offset 0,-0.8
    set ylabel (i % |theta_i| == 0 ? 'BRDF cos θ_r [1/sr]' : '') offset 1,0
    if (i / |theta_i| + 1 == |slope|) { set xlabel 'angle of reflection [°]' offset 0,0.5 }
    plot $lobes index i using 1:2 with points pt 7 ps 0.45 lc rgb '#000000' title 'traced', \
        $lobes index i using 1:3 with lines lw 2.4 lc rgb '#0072b2' title 'this model, rough limit', \
        $lobes index i using 1:4 with lines lw 2 dt 2 lc rgb '#d55e00' \
            title 'Beckmann facets of σ_0, heights correlated'
    set key off
    unset label
}
unset multiplot
