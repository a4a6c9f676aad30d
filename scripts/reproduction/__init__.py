"""Tables 1 and 6-8 and Figs. 3-5, 11-15, 17 and 19 of Qian et al. (2020), run under both contact laws and judged claim by claim.

Source of the claims: Qian, Qin, Yan, Zhang, Mech. Mach. Theory 145 (2020) 103717.
"""
