// The page of a front that nobody measured, to look at: made_up_page > front.html
#include <iostream>

#include "tests/bench/front/made_up.h"
#include "tests/bench/front/page.h"

int main() {
    const bench::front::Front front = bench::front::made_up_front();
    std::cout << bench::front::page_of(front, bench::front::made_up_crops(front));
}
